"""Files of samples as data frames: text, NumPy, MATLAB, HDF5, Parquet, NI TDMS, UFF58."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Callable, Dict, Optional, Union

import pandas as pd

from .._errors import ConfigError
from ._arrays import read_hdf5, read_mat, read_npy, read_npz
from ._instruments import read_tdms, read_uff
from ._tables import read_parquet, read_text
from ._writers import writer_of

_READERS: Dict[str, Callable[[Path], pd.DataFrame]] = {
    ".csv": read_text, ".txt": read_text, ".dat": read_text, ".asc": read_text, ".tsv": read_text,
    ".npz": read_npz, ".npy": read_npy, ".mat": read_mat,
    ".h5": read_hdf5, ".hdf5": read_hdf5, ".hdf": read_hdf5,
    ".parquet": read_parquet, ".pq": read_parquet,
    ".tdms": read_tdms, ".uff": read_uff, ".unv": read_uff, ".uf": read_uff,
}


def read(path: "Union[str, os.PathLike[str]]", *, sampling_hz: Optional[float] = None
         ) -> pd.DataFrame:
    """All channels of a file, one column each, every number as a double.

    `attrs["sampling_hz"]` has the samples a second where the file tells (TDMS, UFF58) or
    `sampling_hz` is given; the index is then the time `t_s` in seconds. The format goes by the
    file's ending: .csv .txt .dat .tsv (also .gz), .npz .npy, .mat (scipy), .h5 (h5py), .parquet
    (pyarrow), .tdms (npTDMS), .uff .unv (pyuff); an ImportError names the package that is missing.
    Text here is plain: numbers with points, at most one header row. Other text (decimal commas,
    LabVIEW's headers, UTF-16) the program reads itself: name the file in a config.
    """
    file = Path(path)
    endings = [ending.lower() for ending in file.suffixes if ending.lower() != ".gz"]
    reader = _READERS.get(endings[-1] if endings else "")
    if reader is None:
        raise ConfigError(
            f"has an unknown ending, expected one of {' '.join(_READERS)}", file=str(file))
    if not file.is_file():
        raise ConfigError("there is no such file", file=str(file))
    try:
        table = reader(file)
    except (ConfigError, ImportError, OSError):
        raise
    except Exception as error:  # whatever a reader makes of a damaged file
        text = " ".join(str(error).split()) or type(error).__name__
        raise ConfigError(f"cannot be read as {endings[-1]}: {text}", file=str(file)) from error
    if table.empty:
        raise ConfigError("has no channel of numbers", file=str(file))
    rate = sampling_hz if sampling_hz is not None else table.attrs.get("sampling_hz")
    table = table.astype("float64")
    if rate is not None:
        table.attrs["sampling_hz"] = float(rate)
        table.index = pd.Index(range(len(table)), dtype="float64", name="t_s") / float(rate)
    return table


def convert(source: "Union[str, os.PathLike[str]]", target: "Union[str, os.PathLike[str]]", *,
            sampling_hz: Optional[float] = None) -> pd.DataFrame:
    """Reads a file and writes its channels in the format of the target's ending: .csv .csv.gz .mat
    .h5, which the program reads, .npz .parquet. No bit of a number is lost; the sampling rate is
    kept where the format has a place for it (not in CSV). Returns the table."""
    path = Path(target)
    write = writer_of(path)
    table = read(source, sampling_hz=sampling_hz)
    temporary = path.with_name("." + path.name)  # the file appears whole or not at all
    try:
        write(table.reset_index(drop=True), temporary, path)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
    return table
