#!/usr/bin/env python3
"""A type's name is defined once: two definitions of one name are undefined behaviour where they meet.

    check_names.py ROOT

Looks at the classes, structures and enumerations of the headers, which all stand in one namespace.
Names every further definition, as file:line, and exits with 1 where there is one.
"""

import collections
import pathlib
import re
import sys

ROOMS = ["model", "estimation", "diagnosis", "trial", "io", "app"]
# At the start of a line: what is nested in a class is indented.
DEFINITION = re.compile(r"^(?:class|struct|enum class|enum) (\w+)(?: final)?(?: : [^;{]*)? \{")
ALIAS = re.compile(r"^using (\w+) =")


def main():
    root = pathlib.Path(sys.argv[1])
    places = collections.defaultdict(list)
    for room in ROOMS:
        for header in sorted((root / room).rglob("*.h")):
            for number, line in enumerate(header.read_text(encoding="utf-8").split("\n"), 1):
                found = DEFINITION.match(line) or ALIAS.match(line)
                if found:
                    places[found[1]].append(f"{header.relative_to(root).as_posix()}:{number}")
    twice = {name: where for name, where in places.items() if len(where) > 1}
    for name, where in sorted(twice.items()):
        print(f"{where[1]}: {name} is defined in {where[0]} too")
    print(f"{len(places)} names of types, {len(twice)} defined more than once")
    return 1 if twice or not places else 0


if __name__ == "__main__":
    sys.exit(main())
