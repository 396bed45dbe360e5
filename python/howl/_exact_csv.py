"""CSV with each number read as the double nearest to its text."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict

import pandas as pd

# Before pandas 3 the nearest double had to be asked for; since then it is what one gets.
_EXACT: Dict[str, Any] = (
    {"float_precision": "round_trip"} if int(pd.__version__.split(".")[0]) < 3 else {})


def read_csv(path: Path, **how: Any) -> pd.DataFrame:
    table: pd.DataFrame = pd.read_csv(path, **_EXACT, **how)
    return table
