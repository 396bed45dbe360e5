"""Tables: text and Parquet."""

from __future__ import annotations

import gzip
import re
from pathlib import Path

import pandas as pd

from .._errors import ConfigError
from .._exact_csv import read_csv
from ._needs import needed

_NUMBER = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$|^[-+]?(nan|inf)$", re.IGNORECASE)


def read_text(file: Path) -> pd.DataFrame:
    """Columns parted by commas, semicolons, tabs or blanks; comments begin with #."""
    opened = gzip.open if file.suffix.lower() == ".gz" else open
    with opened(file, "rt", encoding="utf-8-sig") as stream:
        first = next((line.strip() for line in stream if line.strip() and line[0] != "#"), "")
    separator = next((mark for mark in (";", "\t", ",") if mark in first), r"\s+")
    cells = [cell.strip().strip('"') for cell in re.split(separator, first)]
    has_header = not all(_NUMBER.match(cell) for cell in cells if cell)
    try:
        table = read_csv(
            file, sep=separator, header=0 if has_header else None, comment="#",
            skipinitialspace=True, encoding="utf-8-sig")
    except (pd.errors.ParserError, UnicodeDecodeError) as error:
        raise ConfigError(f"is not plain text of numbers: {error}", file=str(file)) from error
    table.columns = pd.Index(
        [str(name).strip() if has_header else f"{i + 1}" for i, name in enumerate(table.columns)])
    wrong = [name for name in table.columns if table[name].dtype.kind not in "fiub"]
    if wrong:
        raise ConfigError("has texts that are no numbers, expected numbers with decimal points",
                          file=str(file), key=wrong[0])
    return table


def read_parquet(file: Path) -> pd.DataFrame:
    """Numeric columns; the metadata's key sampling_hz is the sampling rate."""
    parquet = needed("pyarrow.parquet", "pyarrow", file)
    stored = parquet.read_table(file)
    table = stored.to_pandas()
    numeric = [name for name in table.columns if table[name].dtype.kind in "fiub"]
    table = pd.DataFrame({name: table[name].to_numpy() for name in numeric})
    rate = (stored.schema.metadata or {}).get(b"sampling_hz")
    if rate is not None:
        table.attrs["sampling_hz"] = float(rate)
    return table
