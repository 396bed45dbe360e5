"""A config as text: JSON, which is YAML too, with one key a line so that it reads well."""

from __future__ import annotations

import json
import math
import os
from typing import Any, List, Mapping

import numpy as np
import pandas as pd


def plain(value: Any) -> Any:
    """The value with Python's own types alone; NumPy's scalars and arrays, paths and tuples turn
    into numbers, lists and texts."""
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, (np.ndarray, pd.Series, pd.Index)):
        return [plain(one) for one in np.asarray(value).tolist()]
    if isinstance(value, (list, tuple, set, frozenset)):
        return [plain(one) for one in value]
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value


def _number(value: float) -> str:
    if math.isnan(value):
        return ".nan"
    if math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    text = repr(value)  # the shortest text that reads back as the same double
    return text if "e" not in text or "." in text else text.replace("e", ".0e")


def _write(value: Any, indent: int, lines: List[str]) -> None:
    """Appends to the last of the lines."""
    inner = "  " * (indent + 1)
    if isinstance(value, Mapping) and value:
        lines[-1] += "{"
        for i, (key, one) in enumerate(value.items()):
            lines.append(inner + json.dumps(key, ensure_ascii=False) + ": ")
            _write(one, indent + 1, lines)
            lines[-1] += "," if i + 1 < len(value) else "}"
    elif isinstance(value, list) and value and not all(isinstance(x, float) for x in value):
        lines[-1] += "["
        for i, one in enumerate(value):
            lines.append(inner)
            _write(one, indent + 1, lines)
            lines[-1] += "," if i + 1 < len(value) else "]"
    elif isinstance(value, list):
        lines[-1] += "[" + ", ".join(_number(x) for x in value) + "]"
    elif isinstance(value, Mapping):
        lines[-1] += "{}"
    elif isinstance(value, float):
        lines[-1] += _number(value)
    elif value is None or isinstance(value, (bool, int, str)):
        lines[-1] += json.dumps(value, ensure_ascii=False)
    else:
        raise TypeError(f"a config cannot hold {value!r} of type {type(value).__name__}")


def config_text(config: Mapping[str, Any]) -> str:
    lines = [""]
    _write(plain(config), 0, lines)
    return "\n".join(lines) + "\n"
