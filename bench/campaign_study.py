#!/usr/bin/env python3
"""What a campaign costs: rigs, time, memory, and the merge of one shard a rig.

    python3 bench/campaign_study.py HOWL [--rigs 10 100 1000]

Each rig is simulated (two operating points of 0.6 s at 5 kHz), analysed and fitted, on all cores.
The shards to be merged are made of the campaign's rows, one a shard.
"""
import argparse
import hashlib
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

CONFIG = """experiments:
  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}
  - {name: exp2, phi: 0.60, frequency_hz: 214, phase_deg: -10, gain: 11}
"""
CAMPAIGN = """commands: [simulate, analyse, fit]
config: rig.yaml
keep: rows
grid: {{simulate.duration_s: [0.6], seed: {{from: 1, to: {rigs}}}}}
"""


def measured(words, **how):
    """Wall and CPU seconds of a program with all that it starts, and its own peak of memory in MB."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    done = subprocess.run(["/usr/bin/env", "python3", "-c", PEAK, *map(str, words)], text=True,
                          capture_output=True, **how)
    wall_s = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    status, peak_kb = map(int, done.stderr.split("\n")[-2].split())
    return status, wall_s, cpu_s, peak_kb / 1024


# Linux keeps the largest child's peak of the waited-for ones: one process between, one child.
PEAK = """
import os, sys
child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ)
_, status, usage = os.wait4(child, 0)
print(os.waitstatus_to_exitcode(status), usage.ru_maxrss, file=sys.stderr)
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("howl")
    parser.add_argument("--rigs", type=int, nargs="+", default=[10, 100, 1000])
    how = parser.parse_args()
    howl = pathlib.Path(how.howl).resolve()
    print("| rigs | time (s) | CPU (s) | CPU a rig (s) | memory (MB) | page (s) | merge of one shard a rig (s) |")
    print("|---|---|---|---|---|---|---|")
    for rigs in how.rigs:
        folder = pathlib.Path(tempfile.mkdtemp(prefix="howl_campaign_"))
        try:
            (folder / "rig.yaml").write_text(CONFIG)
            (folder / "all.yaml").write_text(CAMPAIGN.format(rigs=rigs))
            status, wall_s, cpu_s, peak_mb = measured(
                [howl, "campaign", "all.yaml", "--out", "one", "--quiet"], cwd=folder)
            assert status == 0, status
            page_s = measured([howl, "report", "one", "--quiet"], cwd=folder)[1]
            merge_s = merge_time(howl, folder, rigs)
            print(f"| {rigs} | {wall_s:.1f} | {cpu_s:.1f} | {cpu_s / rigs:.3f} | {peak_mb:.0f} | {page_s:.1f} "
                  f"| {merge_s:.2f} |", flush=True)
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def merge_time(howl, folder, rigs):
    """Runs each shard by itself (short: its rig's row is put where an interrupted shard left it)."""
    rows = {}
    with open(folder / "one" / "campaign.state", "rb") as state:
        state.readline()
        while line := state.readline():
            key, size, _ = line.split()
            rows[key.decode()] = line + state.read(int(size) + 1)
    # The header of a shard is the program's own: one is run, the others differ in its number.
    subprocess.run([howl, "campaign", "all.yaml", "--out", "many", "--shard", f"1/{rigs}", "--quiet"],
                   cwd=folder, check=True)
    first = folder / "many" / "shards" / f"1-of-{rigs}.campaign.shard"
    header = json.loads(first.read_bytes().split(b"\n", 1)[0])
    for index, key in enumerate(sorted(rows), 1):
        if index == 1:
            continue
        header["shard"] = index
        part = folder / "many" / "shards" / f"{index}-of-{rigs}.campaign.part"
        part.write_bytes(json.dumps(header, separators=(",", ":")).encode() + b"\n" + rows[key])
        subprocess.run([howl, "campaign", "all.yaml", "--out", "many", "--shard", f"{index}/{rigs}",
                        "--quiet"], cwd=folder, check=True)
    status, wall_s, _, _ = measured([howl, "merge", "many", "--quiet"], cwd=folder)
    assert status == 0, status
    for name in ["campaign.csv", "campaign_points.csv", "campaign.json"]:
        one, many = [(folder / out / name).read_bytes() for out in ["one", "many"]]
        assert hashlib.sha256(one).digest() == hashlib.sha256(many).digest(), name
    return wall_s


if __name__ == "__main__":
    sys.exit(main())
