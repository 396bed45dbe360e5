"""What measuring systems write: NI TDMS and universal files (UFF, data set 58)."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, List

import numpy as np
import pandas as pd

from .._errors import ConfigError
from ._needs import needed, table_of

# Two increments that differ by less, relatively, are one: they are stored with few digits.
_SAME_INCREMENT = 1e-6


def _rate(increments: List[float], file: Path) -> float:
    first = increments[0]
    if any(abs(one - first) > _SAME_INCREMENT * first for one in increments):
        raise ConfigError("its channels are sampled at different rates, expected one rate",
                          file=str(file))
    # An increment such as 2e-4 s is the rounded inverse of a rate: 5000 Hz and no digit more.
    rate = 1.0 / first
    return round(rate) if abs(rate - round(rate)) < _SAME_INCREMENT * rate else rate


def _unique(name: str, taken: Dict[str, Any]) -> str:
    made, k = name, 2
    while made in taken:
        made, k = f"{name}_{k}", k + 1
    return made


def read_tdms(file: Path) -> pd.DataFrame:
    """Channels under their own names (GROUP/NAME where two groups share one), scaled as the file
    says."""
    nptdms = needed("nptdms", "npTDMS", file)
    columns: "Dict[str, np.ndarray]" = {}
    increments: List[float] = []
    with nptdms.TdmsFile.open(file) as stored:
        found = [channel for group in stored.groups() for channel in group.channels()]
        names = [channel.name for channel in found]
        for channel in found:
            values = np.asarray(channel[:])
            if values.dtype.kind not in "fiub" or values.size < 2:
                continue
            twice = names.count(channel.name) > 1
            name = f"{channel.group_name}/{channel.name}" if twice else channel.name
            columns[_unique(name, columns)] = values
            if channel.properties.get("wf_increment"):
                increments.append(float(channel.properties["wf_increment"]))
    table = table_of(columns, file)
    if increments:
        table.attrs["sampling_hz"] = _rate(increments, file)
    return table


def read_uff(file: Path) -> pd.DataFrame:
    """Data sets 58 (or 58b) of evenly spaced real samples over time. A channel's name is its id1,
    or its id2 to id5 where that is empty."""
    pyuff = needed("pyuff", "pyuff", file)
    stored = pyuff.UFF(str(file))
    columns: "Dict[str, np.ndarray]" = {}
    increments: List[float] = []
    for i, kind in enumerate(stored.get_set_types()):
        if int(kind) != 58:
            continue
        own = stored.read_sets(i)
        values = np.asarray(own["data"])
        is_time = int(own.get("abscissa_spec_data_type", 17)) in (0, 17)
        if values.dtype.kind != "f" or values.size < 2 or not is_time:
            continue
        ids = [str(own.get(f"id{k}", "")).strip() for k in range(1, 6)]
        name = next((one for one in ids if one and one.upper() != "NONE"), f"set{i + 1}")
        columns[_unique(name, columns)] = values
        increment = float(own.get("abscissa_inc") or 0.0)
        if increment > 0.0:
            increments.append(increment)
    table = table_of(columns, file)
    if increments:
        table.attrs["sampling_hz"] = _rate(increments, file)
    return table
