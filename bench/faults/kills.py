#!/usr/bin/env python3
"""Kills long commands at random moments and lets the same command go on.

    kills.py HOWL [--kills 1000] [--seed 1] [--commands fit,family,...]

A job is run once in peace. Then, in a folder of its own, it is begun, killed (-9) at a moment drawn
from the time that it takes, begun again, and so on, up to six times, and at last left to end. Whenever
nobody runs, each file of results that is there must be that of the run in peace, byte for byte: nothing
half-written is to be seen. At the end all of them must be there, and nothing else: no lock, no
unpublished file, no state. Half of the kills reach the program alone, half all that it has started too.
Prints a line a command; exit status 1 where something was lost or differs.
"""

import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

MOST_IN_A_ROW = 6
# Folders whose files a command works on; a log and times; and what a run that goes on reads.
INNER = ("cases/", "diagnoses/", "rigs/")
TIMED = ("log.jsonl", "trial.csv")
STATES = ("bounds.state", "diagnosis.state")

CONFIGS = pathlib.Path(__file__).resolve().parents[2] / "configs"
RIG = """experiments:
  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}
simulate: {duration_s: 0.85, sampling_hz: 5000}
"""
CAMPAIGN = """configs: [rig.yaml]
grid: {"experiments[0].gain": [11, 12, 13]}
commands: [simulate, fit]
"""
JOBS = {
    "fit": ["fit", "r228.yaml"],
    "family": ["family", "r228.yaml", "--save-every", "0.001"],
    "diagnose": ["diagnose", "records/records.yaml"],
    "trial": ["trial", "rig.yaml", "--cases", "2", "--effects", "none,quantisation", "--severities",
              "large", "--duration", "0.85"],
    "campaign": ["campaign", "campaign.yaml"],
}


class Fault(Exception):
    pass


class Job:
    def __init__(self, howl, folder, name):
        self.name = name
        self.words = [howl, *JOBS[name], "--threads", "1", "--quiet"]
        self.folder = folder
        start = time.monotonic()
        self.finish(folder / f"{name}.peace")
        self.seconds = time.monotonic() - start
        self.expected = self.results(folder / f"{name}.peace")
        if not self.expected:
            raise Fault(f"{name}: writes nothing")

    def start(self, out):
        return subprocess.Popen([*self.words, "--out", str(out)], cwd=self.folder, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, start_new_session=True)

    def finish(self, out):
        run = self.start(out)
        said = run.communicate()[1]
        if run.returncode != 0:
            raise Fault(f"{self.name}: exit status {run.returncode}: {said}")

    @staticmethod
    def files(out):
        return {path.relative_to(out).as_posix(): path for path in sorted(out.rglob("*"))
                if path.is_file()}

    def results(self, out):
        return {name: path.read_bytes() for name, path in self.files(out).items()
                if not name.startswith(INNER) and name not in TIMED}

    def check_what_is_there(self, out):
        for name, path in self.files(out).items():
            if name in self.expected and name not in ("campaign.state",):
                if path.read_bytes() != self.expected[name]:
                    raise Fault(f"{self.name}: {name} is half written, or another's")

    def check_end(self, out):
        found = self.results(out)
        for name in sorted(self.expected.keys() - found.keys()):
            raise Fault(f"{self.name}: {name} is missing")
        for name in sorted(found.keys() - self.expected.keys()):
            raise Fault(f"{self.name}: {name} is left over")
        for name, text in self.expected.items():
            if found[name] != text:
                raise Fault(f"{self.name}: {name} differs")

    def kill_one(self, out, draw):
        """False where the run had ended before its moment came."""
        run = self.start(out)
        moment = time.monotonic() + draw.uniform(0.0, 1.05 * self.seconds)
        while time.monotonic() < moment and run.poll() is None:
            time.sleep(min(0.002, max(0.0, moment - time.monotonic())))
        ended = run.poll() is not None
        if not ended and draw.random() < 0.5:
            os.killpg(run.pid, signal.SIGKILL)
        elif not ended:
            run.kill()
        said = run.communicate()[1]
        if ended and run.returncode != 0:
            raise Fault(f"{self.name}: exit status {run.returncode}: {said}")
        return not ended

    def chain(self, out, most, draw):
        """The number of kills until the job was done, and how many of them found results there."""
        kills = late = 0
        while kills < most and self.kill_one(out, draw):
            kills += 1
            if out.is_dir():
                self.check_what_is_there(out)
                late += any(name in self.expected or name in STATES for name in self.files(out))
        self.finish(out)
        self.check_end(out)
        return kills, late


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("howl")
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--commands", default=",".join(JOBS))
    asked = parser.parse_args()
    draw = random.Random(asked.seed)
    names = asked.commands.split(",")
    howl = str(pathlib.Path(asked.howl).resolve())
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        shutil.copy(CONFIGS / "r228.yaml", folder)
        (folder / "rig.yaml").write_text(RIG)
        (folder / "campaign.yaml").write_text(CAMPAIGN)
        subprocess.run([howl, "simulate", "rig.yaml", "--out", "records", "--quiet"], cwd=folder,
                       check=True)
        total = 0
        for place, name in enumerate(names):
            share = asked.kills // len(names) + (place < asked.kills % len(names))
            try:
                job = Job(howl, folder, name)
                kills = late = chains = 0
                while kills < share:
                    most = min(MOST_IN_A_ROW, share - kills)
                    done, found = job.chain(folder / f"{name}.{chains}", most, draw)
                    kills += done
                    late += found
                    chains += 1
            except Fault as fault:
                print(f"seed {asked.seed}: {fault}")
                return 1
            total += kills
            print(f"{name}: {kills} kills in {chains} runs of {job.seconds:.2f} s, {late} with results "
                  "or states there; all ended in the bytes of the run in peace", flush=True)
    print(f"{total} kills: nothing lost, nothing half-written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
