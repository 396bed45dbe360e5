"""Files of named arrays: NPY, NPZ, MATLAB, HDF5."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict

import numpy as np
import pandas as pd

from ._needs import channels, needed, table_of


def _of_arrays(arrays: Dict[str, Any], file: Path) -> pd.DataFrame:
    """A scalar named sampling_hz (or fs) is the sampling rate; every other array is channels."""
    columns: "Dict[str, np.ndarray]" = {}
    for name, values in arrays.items():
        columns.update(channels(name, values))
    table = table_of(columns, file)
    for name in ("sampling_hz", "fs", "Fs"):
        rate = np.asarray(arrays.get(name, ()))
        if rate.size == 1 and rate.dtype.kind in "fiu":
            table.attrs["sampling_hz"] = float(rate.reshape(-1)[0])
            break
    return table


def read_npz(file: Path) -> pd.DataFrame:
    with np.load(file, allow_pickle=False) as stored:
        return _of_arrays({name: stored[name] for name in stored.files}, file)


def read_npy(file: Path) -> pd.DataFrame:
    array = np.load(file, allow_pickle=False)
    if array.dtype.names:  # a structured array: its fields are the channels
        return _of_arrays({name: array[name] for name in array.dtype.names}, file)
    return _of_arrays({file.stem: array}, file)


def read_mat(file: Path) -> pd.DataFrame:
    """Versions 4 to 7 by scipy; 7.3 is HDF5."""
    with open(file, "rb") as stream:
        is_hdf5 = stream.read(600)[512:516] == b"\x89HDF"
    if is_hdf5:
        return read_hdf5(file)
    scipy_io = needed("scipy.io", "scipy", file)
    stored = scipy_io.loadmat(file)
    return _of_arrays({k: v for k, v in stored.items() if not k.startswith("__")}, file)


def read_hdf5(file: Path) -> pd.DataFrame:
    h5py = needed("h5py", "h5py", file)
    arrays: Dict[str, Any] = {}

    def take(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiub":
            arrays[name] = item[()]

    with h5py.File(file, "r") as stored:
        stored.visititems(take)
    return _of_arrays(arrays, file)
