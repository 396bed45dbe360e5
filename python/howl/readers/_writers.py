"""A table of channels as a file that the program reads."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Callable, Dict

import numpy as np
import pandas as pd

from .._errors import ConfigError
from .._mat5 import write_mat5
from ._needs import needed

# Writes to the first path; the second is what the user calls it.
Writer = Callable[[pd.DataFrame, Path, Path], None]


def _arrays(table: pd.DataFrame) -> "Dict[str, np.ndarray]":
    arrays = {str(name): table[name].to_numpy(dtype=float) for name in table.columns}
    if table.attrs.get("sampling_hz"):
        arrays["sampling_hz"] = np.array([table.attrs["sampling_hz"]], dtype=float)
    return arrays


def _write_csv(table: pd.DataFrame, path: Path, target: Path) -> None:
    """Each number is the shortest text that reads back as the same double."""
    table.to_csv(path, index=False)


def _write_csv_gz(table: pd.DataFrame, path: Path, target: Path) -> None:
    table.to_csv(path, index=False, compression={"method": "gzip", "mtime": 0})


def _write_mat(table: pd.DataFrame, path: Path, target: Path) -> None:
    arrays = _arrays(table)
    wrong = [name for name in arrays if not (name.isidentifier() and name.isascii())]
    if wrong:
        raise ConfigError("is no name of a MATLAB variable, expected letters, digits and _",
                          file=str(target), key=wrong[0])
    write_mat5(path, arrays)


def _write_hdf5(table: pd.DataFrame, path: Path, target: Path) -> None:
    h5py = needed("h5py", "h5py", target)
    with h5py.File(path, "w") as stored:
        for name, values in _arrays(table).items():
            stored[name] = values


def _write_npz(table: pd.DataFrame, path: Path, target: Path) -> None:
    arrays = _arrays(table)
    with zipfile.ZipFile(path, "w") as stored:  # np.savez takes no name such as "file"
        for name, values in arrays.items():
            with stored.open(name + ".npy", "w") as stream:
                np.lib.format.write_array(stream, values, allow_pickle=False)


def _write_parquet(table: pd.DataFrame, path: Path, target: Path) -> None:
    parquet = needed("pyarrow.parquet", "pyarrow", target)
    pyarrow = needed("pyarrow", "pyarrow", target)
    stored = pyarrow.table({str(name): table[name].to_numpy() for name in table.columns})
    if table.attrs.get("sampling_hz"):
        stored = stored.replace_schema_metadata(
            {b"sampling_hz": repr(float(table.attrs["sampling_hz"])).encode()})
    parquet.write_table(stored, path)


WRITERS: "Dict[str, Writer]" = {
    ".csv": _write_csv, ".csv.gz": _write_csv_gz, ".mat": _write_mat, ".h5": _write_hdf5,
    ".hdf5": _write_hdf5, ".npz": _write_npz, ".parquet": _write_parquet,
}


def writer_of(path: Path) -> Writer:
    name = path.name.lower()
    for ending in sorted(WRITERS, key=len, reverse=True):
        if name.endswith(ending):
            return WRITERS[ending]
    raise ConfigError(f"has an unknown ending, expected one of {' '.join(WRITERS)}",
                      file=str(path))
