#!/usr/bin/env python3
"""Includes run one way: a room uses itself and the rooms above it in its list, no others.

    check_arrows.py ROOT

Names every include that points back, as file:line, and every folder that a list should have and has
not; exits with 1 where there is one.
"""

import pathlib
import re
import sys

# In order: a room may use those that stand before it. A folder belongs to the nearest room above it.
# A list that ends with its own folder has all folders below that.
LISTS = {
    "": ["model", "estimation", "diagnosis", "trial", "io", "app"],
    "model": ["model/numerics", "model/noise", "model/loop", "model/cycles", "model/delay_systems",
              "model/simulation", "model/effects", "model/effects/forms", "model"],
    "estimation": ["estimation/analysis", "estimation/record_fit/spectra",
                   "estimation/record_fit/whittle", "estimation/record_fit/loop",
                   "estimation/record_fit/slow", "estimation/record_fit/starts",
                   "estimation/record_fit", "estimation/joint_records",
                   "estimation/residuals", "estimation/fit",
                   "estimation/family/problem", "estimation/family/local",
                   "estimation/family/members/drawer", "estimation/family/members",
                   "estimation/family/bounds/contract", "estimation/family/bounds",
                   "estimation/family/answers/conflict", "estimation/family/answers/predict",
                   "estimation/family/answers", "estimation/health"],
    "analysis": ["estimation/analysis/spectra", "estimation/analysis/cycle",
                 "estimation/analysis/oscillations", "estimation/analysis/transfer",
                 "estimation/analysis/instruments", "estimation/analysis/flame",
                 "estimation/analysis/loop", "estimation/analysis"],
    "diagnosis": ["diagnosis/numerics", "diagnosis/records", "diagnosis/noise", "diagnosis/cuts",
                  "diagnosis/fit", "diagnosis/gap", "diagnosis/samples", "diagnosis/reference",
                  "diagnosis/held_out", "diagnosis/verdict",
                  "diagnosis/loop_budget/forms", "diagnosis/loop_budget/trials",
                  "diagnosis/loop_budget/search", "diagnosis/loop_budget/account",
                  "diagnosis/loop_budget",
                  "diagnosis/candidates", "diagnosis/localise",
                  "diagnosis/search", "diagnosis/plan", "diagnosis/table", "diagnosis"],
    "io": ["io/config/yaml", "io/config/schema", "io/records/columns", "io/records/text",
           "io/records/binary", "io/records", "io/config", "io/config/sections", "io/config/reading",
           "io/results", "io/results/family", "io/inspect", "io/report", "io/report/figures",
           "io/report/summary", "io/report/page"],
    "app": ["app/files", "app/process", "app/text", "app/command_line", "app/jobs", "app/input",
            "app/simulate", "app/fit", "app/family", "app/diagnose", "app/check", "app/trial",
            "app/campaign", "app/help", "app/commands", "app"],
}
# howl_rig is a second simulator, so that a trial is no comparison of a program with itself.
ALONE = ["rig"]
# Neither of these two knows of the other, whatever their order.
APART = [("diagnosis", "trial")]


def room_of(path, rooms):
    inside = [room for room in rooms if path == room or path.startswith(room + "/")]
    return max(inside, key=len, default=None)


def unlisted(root):
    for rooms in LISTS.values():
        last = rooms[-1]
        if not all(room == last or room.startswith(last + "/") for room in rooms):
            continue
        folders = {s.parent.relative_to(root).as_posix() for s in (root / last).rglob("*.[hc]*")}
        yield from (f"{folder}: stands in no list" for folder in sorted(folders - {last})
                    if room_of(folder, rooms) == last)


def faults(path, included):
    for rooms in LISTS.values():
        mine, other = room_of(path, rooms), room_of(included, rooms)
        if mine and other and rooms.index(other) > rooms.index(mine):
            yield f"{mine} uses {other}, which stands above it"
    for alone in ALONE:
        if (room_of(path, [alone]) is None) != (room_of(included, [alone]) is None):
            yield f"{alone} stands alone"
    for pair in APART:
        if {room_of(path, pair), room_of(included, pair)} == set(pair):
            yield f"{pair[0]} and {pair[1]} stand apart"


def main():
    root = pathlib.Path(sys.argv[1])
    found = counted = 0
    for fault in unlisted(root):
        found += 1
        print(fault)
    for top in LISTS[""] + ALONE:
        for source in sorted((root / top).rglob("*.[hc]*")):
            path = source.relative_to(root).as_posix()
            for number, line in enumerate(source.read_text(encoding="utf-8").split("\n"), 1):
                include = re.match(r'#include "([^"]+)"', line)
                if not include:
                    continue
                counted += 1
                for fault in faults(path, include[1]):
                    found += 1
                    print(f"{path}:{number}: {include[1]}: {fault}")
    print(f"{counted} includes, {found} faults of the order of the rooms")
    return 1 if found or counted == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
