"""What a computation starts from: arrays, a table, a dict or a config's path."""

from __future__ import annotations

import dataclasses
import hashlib
import os
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import pandas as pd

from ._errors import ConfigError, parse_error
from ._mat5 import write_mat5
from ._tree import config_text, plain

Array = Union[np.ndarray, pd.Series, Sequence[float]]


@dataclasses.dataclass
class Experiment:
    """One operating point: a record of p and q, or the characteristics of a published table.

    `phi` is the operating parameter (the equivalence ratio, unless the config's
    `operating_parameter` names another). `p` and `q` are samples of pressure and heat release taken
    together at `sampling_hz` samples a second; without `q` the record is of pressure alone.
    `record` has further keys of the config's `record:` (`start_s`, `duration_s`, `pressure_scale`,
    `delay_s`, ...). `frequency_hz`, `phase_deg` (from q to p, negative where p lags q), `gain`
    (units of p per unit of q) and `flame_slope` (q per p/s) stand in the place of a record.
    An experiment that is not `reliable` weighs less.
    """

    phi: float
    p: Optional[Array] = None
    q: Optional[Array] = None
    sampling_hz: Optional[float] = None
    name: Optional[str] = None
    frequency_hz: Optional[float] = None
    phase_deg: Optional[float] = None
    gain: Optional[float] = None
    flame_slope: Optional[float] = None
    reliable: bool = True
    record: Mapping[str, Any] = dataclasses.field(default_factory=dict)

    def __repr__(self) -> str:
        what = f"{np.size(self.p)} samples" if self.p is not None else "characteristics"
        return f"Experiment({self.name or 'unnamed'}, phi={self.phi!r}, {what})"


class Problem:
    """A config in a file, with its records, and the folder for what is found. The temporary folder
    that holds what was not on disk is removed with the last result that refers to it."""

    def __init__(self, config: Path, temporary: "Optional[tempfile.TemporaryDirectory[str]]",
                 out: Path, key: str, arrays: Mapping[str, str]) -> None:
        self.config = config
        self.out = out
        self.key = key
        self._temporary = temporary
        self._arrays = dict(arrays)  # the file of an array's record -> its place in the config

    @property
    def is_temporary(self) -> bool:
        """The config was written for this problem: its name and lines mean nothing to the user."""
        return self._temporary is not None and self._temporary.name in str(self.config)

    def error(self, text: str) -> ConfigError:
        """The exception of the program's line of a mistake, with places as the user has them."""
        error = parse_error(text, [str(self.config), *self._arrays])
        if error.file in self._arrays:
            where = self._arrays[str(error.file)]
            key = f"{where}.{error.key}" if error.key else where
            message = error.message
            if message.startswith("sample"):
                message += "; samples count from 1"
            return ConfigError(message, key=key)
        if error.file == str(self.config) and self.is_temporary:
            return ConfigError(error.message, key=error.key)
        return error


def is_signal(value: Any) -> bool:
    """Samples, or several rows of samples, rather than a config or experiments."""
    if isinstance(value, (np.ndarray, pd.Series)):
        return True
    if isinstance(value, (list, tuple)) and value:
        return is_signal(value[0]) or isinstance(value[0], (int, float, np.number))
    return False


def _rows(signal: Any, what: str) -> List[np.ndarray]:
    if isinstance(signal, (list, tuple)) and signal and is_signal(signal[0]):
        return [samples(one, what) for one in signal]
    values = np.asarray(signal)
    if values.ndim == 2:
        return [samples(row, what) for row in values]
    return [samples(values, what)]


def samples(values: Any, what: str) -> np.ndarray:
    """One-dimensional doubles."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise ConfigError(f"is of type {array.dtype}, expected real numbers", key=what)
    if array.ndim != 1:
        raise ConfigError(f"has the shape {array.shape}, expected one row of samples", key=what)
    return np.ascontiguousarray(array, dtype=np.float64)


def experiments_of_arrays(
    p: Any, q: Any, sampling_hz: Any, phi: Any, name: Any
) -> List[Experiment]:
    """One experiment for each row of p."""
    all_p = _rows(p, "p")
    count = len(all_p)
    all_q: List[Optional[np.ndarray]] = [None] * count if q is None else list(_rows(q, "q"))
    if sampling_hz is None:
        raise ConfigError("is missing, expected the samples a second of p and q", key="sampling_hz")
    if phi is None:
        raise ConfigError("is missing, expected the operating parameter, one for each row of p",
                          key="phi")
    every_phi = np.atleast_1d(np.asarray(phi, dtype=float)).tolist()
    every_rate = np.broadcast_to(np.asarray(sampling_hz, dtype=float), (count,)).tolist()
    names = [None] * count if name is None else [name] if isinstance(name, str) else list(name)
    for what, got in (("q", len(all_q)), ("phi", len(every_phi)), ("name", len(names))):
        if got != count:
            raise ConfigError(f"{got} of them, expected {count}, as many as rows of p", key=what)
    return [
        Experiment(phi=every_phi[i], p=all_p[i], q=all_q[i], sampling_hz=every_rate[i],
                   name=names[i])
        for i in range(count)
    ]


def _as_dict(experiment: Experiment, number: int, parameter: str) -> Dict[str, Any]:
    own: Dict[str, Any] = {"name": experiment.name or f"exp{number}", parameter: experiment.phi}
    for key in ("frequency_hz", "phase_deg", "gain", "flame_slope"):
        value = getattr(experiment, key)
        if value is not None:
            own[key] = value
    if not experiment.reliable:
        own["reliable"] = False
    if experiment.p is not None:
        record: Dict[str, Any] = {"pressure": np.asarray(experiment.p)}
        if experiment.q is not None:
            record["heat_release"] = np.asarray(experiment.q)
        if experiment.sampling_hz is not None:
            record["sampling_hz"] = experiment.sampling_hz
        own["record"] = {**record, **experiment.record}
    elif experiment.record:
        own["record"] = dict(experiment.record)
    return own


def _of_table(table: pd.DataFrame) -> List[Dict[str, Any]]:
    """One experiment a row; the columns are the keys, and what is missing (NaN) is left out."""
    if "name" not in table.columns and table.index.name == "name":
        table = table.reset_index()
    rows = []
    for i, row in enumerate(table.to_dict("records")):
        own = {str(key): value for key, value in row.items() if not pd.isna(value)}
        rows.append({"name": f"exp{i + 1}", **own})
    return rows


def as_config(problem: Any, extra: Optional[Mapping[str, Any]]) -> Dict[str, Any]:
    """The config as nested dicts, signals still being arrays."""
    config: Dict[str, Any] = {}
    if isinstance(problem, Mapping):
        config.update(problem)
    elif isinstance(problem, pd.DataFrame):
        config["experiments"] = _of_table(problem)
    elif isinstance(problem, Experiment):
        config["experiments"] = [problem]
    else:
        config["experiments"] = list(problem)
    config.update(extra or {})
    parameter = str(config.get("operating_parameter", "phi"))
    listed = config.get("experiments")
    if isinstance(listed, pd.DataFrame):
        listed = _of_table(listed)
    if isinstance(listed, (list, tuple)):
        config["experiments"] = [
            _as_dict(one, i + 1, parameter) if isinstance(one, Experiment) else one
            for i, one in enumerate(listed)
        ]
    return config


def _take_arrays(
    config: Dict[str, Any], folder: Path
) -> Tuple[Dict[str, Any], Dict[str, str], bytes]:
    """Writes the arrays of each record to a file and puts its name in their place."""
    arrays: Dict[str, str] = {}
    digest = hashlib.sha256()
    listed = config.get("experiments")
    if not isinstance(listed, (list, tuple)):
        return config, arrays, b""
    rewritten = []
    for i, experiment in enumerate(listed):
        record = experiment.get("record") if isinstance(experiment, Mapping) else None
        if isinstance(record, Mapping) and is_signal(record.get("pressure")):
            where = f"experiments[{i}].record"
            columns = {"p": samples(record["pressure"], f"{where}.pressure")}
            own = {"file": f"record{i + 1}.mat", **record, "pressure": "p"}
            if own.get("heat_release") is None:
                own.pop("heat_release", None)
            else:
                columns["q"] = samples(record["heat_release"], f"{where}.heat_release")
                own["heat_release"] = "q"
                if columns["q"].size != columns["p"].size:
                    raise ConfigError(
                        f"has {columns['q'].size} samples, expected {columns['p'].size}, as many "
                        "as pressure", key=f"{where}.heat_release")
            for column in columns.values():
                digest.update(column.data)
            path = folder / own["file"]
            write_mat5(path, columns)
            arrays[str(path)] = where
            experiment = {**experiment, "record": own}
        elif isinstance(record, Mapping):
            experiment = {**experiment, "record": _absolute(record)}
        rewritten.append(experiment)
    return {**config, "experiments": rewritten}, arrays, digest.digest()


def _absolute(record: Mapping[str, Any]) -> Dict[str, Any]:
    """Paths in a dict are relative to the working directory, for a dict is in no folder."""
    own = dict(record)
    for key in ("file", "pressure_response", "heat_release_response"):
        value = own.get(key)
        if not isinstance(value, (str, os.PathLike)):
            continue
        text = os.fspath(value)
        # A response may be a formula as well: it is a table's path where there is such a file.
        if not text.startswith("${") and (key == "file" or os.path.isfile(text)):
            own[key] = os.path.abspath(text)
    return own


def write_problem(config: Dict[str, Any], folder: Path) -> Tuple[Path, Dict[str, str], str]:
    """Writes config.yaml and the records of a problem to a folder. Returns the config's path, the
    files of arrays, and what tells this problem from others."""
    folder.mkdir(parents=True, exist_ok=True)
    named, arrays, digest = _take_arrays(config, folder)
    text = config_text(plain(named))
    path = folder / "config.yaml"
    path.write_text(text, encoding="utf-8")
    key = hashlib.sha256(digest + text.replace(str(folder), "").encode()).hexdigest()
    return path, arrays, key
