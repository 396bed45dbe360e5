#!/usr/bin/env python3
"""Only the program writes to the terminal: a library that prints spoils its user's output.

    check_output.py ROOT

Names every line of the library's rooms that writes to standard output or standard error, as file:line,
and exits with 1 where there is one. Steps of a search are told by VLOG, which says nothing unasked.
"""

import pathlib
import re
import sys

ROOMS = ["model", "estimation", "diagnosis", "trial", "io"]
WRITES = re.compile(r"\b(?:v?f?printf|f?puts|f?putc|putchar|perror)\s*\(|std::(?:cout|cerr|clog)\b"
                    r"|\b(?:stdout|stderr)\b")
QUOTED = re.compile(r'"(?:\\.|[^"\\])*"')


def main():
    root = pathlib.Path(sys.argv[1])
    sources = sorted(s for room in ROOMS for s in (root / room).rglob("*.[hc]*"))
    found = 0
    for source in sources:
        for number, line in enumerate(source.read_text(encoding="utf-8").split("\n"), 1):
            code = QUOTED.sub('""', line).split("//")[0]
            if WRITES.search(code):
                print(f"{source.relative_to(root).as_posix()}:{number}: {line.strip()}")
                found += 1
    print(f"{len(sources)} sources of the library, {found} lines that write to the terminal")
    return 1 if found or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
