"""A problem in files: what a computation starts from, and where its results go."""

from __future__ import annotations

import hashlib
import os
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Tuple

import pandas as pd

from ._errors import ConfigError, parse_error
from ._experiment import Experiment, as_dict, is_signal, samples
from ._mat5 import write_mat5
from ._tree import config_text


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


def _of_table(table: pd.DataFrame, parameter: str) -> List[Dict[str, Any]]:
    """One experiment a row; the columns are the keys, and what is missing (NaN) is left out."""
    if "name" not in table.columns and table.index.name == "name":
        table = table.reset_index()
    if parameter not in table.columns:
        raise ConfigError(
            "is no column of the table, expected one with a row for each experiment; samples go in "
            'as arrays: (table["p"], table["q"], sampling_hz=..., phi=...)', key=parameter)
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
        config["experiments"] = problem
    elif isinstance(problem, Experiment):
        config["experiments"] = [problem]
    else:
        config["experiments"] = list(problem)
    config.update(extra or {})
    parameter = str(config.get("operating_parameter", "phi"))
    listed = config.get("experiments")
    if isinstance(listed, pd.DataFrame):
        config["experiments"] = listed = _of_table(listed, parameter)
    if isinstance(listed, (list, tuple)):
        config["experiments"] = [
            as_dict(one, i + 1, parameter) if isinstance(one, Experiment) else one
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
    text = config_text(named)
    path = folder / "config.yaml"
    path.write_text(text, encoding="utf-8")
    key = hashlib.sha256(digest + text.replace(str(folder), "").encode()).hexdigest()
    return path, arrays, key
