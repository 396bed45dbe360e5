"""Packages that one format alone needs."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any, Dict

import numpy as np
import pandas as pd

from .._errors import ConfigError


def needed(module: str, package: str, file: Path) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{file}: its format needs {package}: pip install {package}") from error


def table_of(columns: "Dict[str, np.ndarray]", file: Path) -> pd.DataFrame:
    """Columns of one length."""
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise ConfigError(f"its channels have different numbers of samples ({listed}), expected "
                          "one number", file=str(file))
    return pd.DataFrame({name: np.asarray(values, dtype=float) for name, values in columns.items()})


def channels(name: str, values: Any) -> "Dict[str, np.ndarray]":
    """An array's columns: a vector under its name, a matrix's channels as NAME:1, NAME:2 along its
    shorter side, as the program counts them. Empty for what is no array of real numbers."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub" or array.size < 2:
        return {}
    array = array.squeeze()
    if array.ndim == 1:
        return {name: array}
    if array.ndim != 2:
        return {}
    if array.shape[0] < array.shape[1]:
        array = array.T
    return {f"{name}:{k + 1}": array[:, k] for k in range(array.shape[1])}
