"""The installed headers are the front headers and what those include, no more and no fewer."""

import pathlib
import re
import sys


def listed(text, name):
    return set(re.search(rf"set\({name}\s+([^)]*)\)", text).group(1).split())


def included(root, fronts):
    """fronts, and every header of this tree that they include, directly or not."""
    found, open_files = set(), list(fronts)
    while open_files:
        header = open_files.pop()
        if header in found:
            continue
        found.add(header)
        open_files += re.findall(r'#include "([^"]+)"', (root / header).read_text())
    return found


def main():
    root = pathlib.Path(sys.argv[1])
    text = (root / "cmake/installed_headers.cmake").read_text()
    fronts = listed(text, "howl_front_headers")
    others = listed(text, "howl_included_headers")
    needed = included(root, fronts)
    mistakes = [f"{h}: a front header includes it: it is to be installed"
                for h in sorted(needed - fronts - others)]
    mistakes += [f"{h}: no front header includes it: it is not to be installed"
                 for h in sorted(others - needed)]
    mistakes += [f"{h}: listed twice" for h in sorted(fronts & others)]
    if not needed or mistakes:
        sys.exit("cmake/installed_headers.cmake:\n" + "\n".join(mistakes or ["no header at all"]))
    print(f"{len(fronts)} front headers, {len(needed)} installed")


main()
