#!/usr/bin/env python3
"""What share of the readers' lines the inputs of tests/fuzz/corpus reach.

    cmake --preset fuzz -DHOWL_COVERAGE=ON && cmake --build --preset fuzz
    tests/fuzz/coverage.py build-fuzz [--found] [--missed FILE] [--update]

Reads each input by its target, and prints the lines covered by kind of reader: the table of docs/faults.md, which
--update writes there. --found adds what fuzzing has found (BUILD/corpus). --missed prints the lines of one file
that no input reaches. Lines that only a child process runs, which reads MATLAB and HDF5 files first, are run by
the program itself too where the child lived.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
PAGE = PROJECT / "docs/faults.md"
MARK = "<!-- coverage -->\n"
# What reads, and not what writes, runs or draws.
READERS = [
    ("configs", r"io/config/"),
    ("campaigns and jobs", r"app/(campaign/campaign_(spec|rigs)|input/derived_config)\.cc|app/jobs/job_spec\.cc"),
    ("records as text or gzip", r"io/records/(text|columns)/"),
    ("records of MATLAB or HDF5", r"io/records/binary/"),
    ("records of any format", r"io/records/(?!write_record)[a-z_]*\.cc"),
    ("the look at a record", r"io/inspect/"),
    ("results", r"io/report/(read_|csv_table|report_input|run_file|family_members)|"
                r"io/results/(reference_file|family/family_csv)"),
    ("states, shards, logs", r"app/jobs/(shard_set|submitted_job|unit_store)|app/trial/trial_(log|folder|score)|"
                             r"app/campaign/(rig_row|campaign_tables)|estimation/family/bounds/bound_text|"
                             r"estimation/joint_records/fit_units|diagnosis/fit/fit_memory"),
]


def run_targets(build, folder, found):
    """Each target over its inputs; the merged counts."""
    targets = sorted(path for path in build.glob("fuzz_*") if os.access(path, os.X_OK) and path.is_file())
    if not targets:
        sys.exit(f"{build}: no fuzz targets, expected them of cmake --build --preset fuzz")
    for target in targets:
        name = target.name.removeprefix("fuzz_")
        inputs = [PROJECT / "tests/fuzz/corpus" / name]
        if found and (build / "corpus" / name).is_dir():
            inputs.append(build / "corpus" / name)
        done = subprocess.run([target, "-runs=0", "-close_fd_mask=1", *inputs], capture_output=True, text=True,
                              env={**os.environ, "LLVM_PROFILE_FILE": f"{folder}/{name}.profraw"}, check=False)
        if done.returncode != 0:
            sys.exit(f"{target} fails:\n{done.stderr}")
    merged = folder / "all.profdata"
    subprocess.run(["llvm-profdata-14", "merge", "-sparse", "-o", merged, *folder.glob("*.profraw")], check=True)
    return targets[0], merged


def table(target, merged):
    data = subprocess.run(["llvm-cov-14", "export", "-summary-only", f"-instr-profile={merged}", target],
                          capture_output=True, check=True).stdout
    files = {os.path.relpath(each["filename"], PROJECT): each["summary"]["lines"]
             for each in json.loads(data)["data"][0]["files"]}
    lines = ["| readers of | lines | reached |", "|---|---|---|"]
    total = reached = 0
    for what, pattern in READERS:
        some = [each for name, each in files.items() if re.match(pattern, name)]
        count, covered = sum(each["count"] for each in some), sum(each["covered"] for each in some)
        if count == 0:
            sys.exit(f"{what}: no file, expected this program to be built with -DHOWL_COVERAGE=ON")
        lines.append(f"| {what} | {count} | {100 * covered / count:.0f} % |")
        total, reached = total + count, reached + covered
    lines.append(f"| all of these | {total} | {100 * reached / total:.0f} % |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--found", action="store_true")
    parser.add_argument("--missed", metavar="FILE")
    parser.add_argument("--update", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        target, merged = run_targets(args.build.resolve(), pathlib.Path(folder), args.found)
        if args.missed:
            shown = subprocess.run(["llvm-cov-14", "show", f"-instr-profile={merged}", target,
                                    str(PROJECT / args.missed)], capture_output=True, text=True, check=True)
            print("\n".join(line for line in shown.stdout.splitlines() if re.match(r"\s*\d+\|\s*0\|", line)))
            return
        rows = table(target, merged)
    print(rows, end="")
    if args.update:
        text = PAGE.read_text(encoding="utf-8")
        head, tail = text.split(MARK, 1)
        PAGE.write_text(head + MARK + rows + tail[tail.index("\n\n") + 1:], encoding="utf-8")


if __name__ == "__main__":
    main()
