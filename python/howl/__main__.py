"""python -m howl convert IN OUT.csv turns a file of samples into CSV; every other command is the
program's: python -m howl fit CONFIG."""

from __future__ import annotations

import argparse
import os
import sys
from typing import List

from ._errors import ConfigError, ProgramError
from ._program import find_program
from .readers import convert


def _convert(words: List[str]) -> int:
    parser = argparse.ArgumentParser(
        prog="python -m howl convert",
        description="Turns a file of samples (TDMS, UFF58, Parquet, NPZ, MATLAB, HDF5, text) into "
        "CSV that howl reads, with no bit of a number lost.")
    parser.add_argument("input", metavar="IN")
    parser.add_argument("output", metavar="OUT.csv", help="or OUT.csv.gz")
    arguments = parser.parse_args(words)
    if not arguments.output.endswith((".csv", ".csv.gz")):
        parser.error(f"{arguments.output}: expected a name that ends with .csv or .csv.gz")
    try:
        table = convert(arguments.input, arguments.output)
    except (ConfigError, ImportError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    rate = table.attrs.get("sampling_hz")
    told = f"sampling_hz: {rate:.17g}" if rate else "the file tells no sampling rate"
    print(f"{', '.join(map(str, table.columns))}: {len(table)} samples each; {told}")
    print(f"written: {arguments.output}")
    return 0


def main() -> int:
    words = sys.argv[1:]
    if words[:1] == ["convert"]:
        return _convert(words[1:])
    try:
        program = str(find_program())
    except ProgramError as error:
        print(error, file=sys.stderr)
        return 2
    sys.stdout.flush()
    os.execv(program, [program, *words])
    return 0  # for the type checker: execv does not return


if __name__ == "__main__":
    sys.exit(main())
