"""python -m howl convert IN OUT.csv turns a file of samples into one that the program reads; every
other command is the program's: python -m howl fit CONFIG."""

from __future__ import annotations

import argparse
import math
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
        "one that howl reads, with no bit of a number lost.")
    parser.add_argument("input", metavar="IN")
    parser.add_argument("output", metavar="OUT", help="its format goes by its ending: .csv "
                        ".csv.gz .mat .h5, which howl reads, .npz .parquet")
    parser.add_argument("--sampling-hz", type=float, metavar="HZ",
                        help="samples a second, where the file does not tell")
    arguments = parser.parse_args(words)
    if arguments.sampling_hz is not None and not 0.0 < arguments.sampling_hz < math.inf:
        parser.error(f"--sampling-hz: {arguments.sampling_hz}, expected a positive number")
    try:
        table = convert(arguments.input, arguments.output, sampling_hz=arguments.sampling_hz)
    except (ConfigError, ImportError, OSError, ValueError) as error:
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
