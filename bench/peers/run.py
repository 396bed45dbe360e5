"""All comparisons of howl with its peers in one run: one table (peers.md) and one JSON.

  run.py --howl BUILD/howl [--out DIR] [--only NAME,...] [--quick]

Run by run.sh, in the virtual environment that it makes. A comparison that cannot run is named in
the table with the reason.
"""
import os

# Every program has one thread, before any of them is imported.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import argparse
import importlib
import importlib.metadata
import json
import pathlib
import platform
import time
import traceback

from common import Howl, Table

HERE = pathlib.Path(__file__).resolve().parent
COMPARISONS = ["joint_fit", "bounds", "members", "simulation", "limit_cycles", "identification",
               "diagnosis"]


def versions():
    """Of every requirement, or why there is none."""
    found = {"python": platform.python_version()}
    for line in (HERE / "requirements.txt").read_text().splitlines():
        name = line.partition("==")[0].strip()
        if not name or name.startswith("#"):
            continue
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = "not installed"
    return found


def write(out, table, head, found, seconds):
    out.mkdir(parents=True, exist_ok=True)
    (out / "peers.md").write_text(table.markdown(head) + "\n")
    (out / "peers.json").write_text(json.dumps(
        {"schema": "howl.peers/1", "versions": found, "seconds": seconds, "rows": table.rows,
         "notes": table.notes}, indent=1) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--howl", required=True, help="the program")
    parser.add_argument("--out", default=str(HERE / "out"), type=pathlib.Path)
    parser.add_argument("--only", default=",".join(COMPARISONS), help="comparisons, by comma")
    parser.add_argument("--quick", action="store_true", help="few repeats: does everything run?")
    options = parser.parse_args()
    os.environ["HOWL_PEERS_WORK"] = str(options.out)  # where rigs and their diagnoses are kept
    howl = Howl(options.howl)
    found = {"howl": howl.version, **versions()}
    listed = ", ".join(f"{name} {version}" for name, version in found.items())
    print(listed, flush=True)
    head = ["# howl and its peers", "", listed + ".", "",
            "Median (quartiles) of repeats in turns; times are CPU seconds on one thread."]
    table, seconds = Table(), {}
    for name in options.only.split(","):
        print(f"{name}:", flush=True)
        begin = time.perf_counter()
        try:
            comparison = importlib.import_module(name)
            comparison.compare(howl, table, options.quick)
        except Exception as error:  # whatever it was, the other comparisons go on
            traceback.print_exc()
            reason = str(error).splitlines()[0][:200] if str(error) else ""
            table.note(name, f"not run to its end: {type(error).__name__}: {reason}")
        seconds[name] = time.perf_counter() - begin
        write(options.out, table, head, found, seconds)
    print(f"written: peers.md and peers.json in {options.out}")


if __name__ == "__main__":
    main()
