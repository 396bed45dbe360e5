#!/usr/bin/env python3
"""A trial in shards on a Slurm of one node, with faults, against the same trial in one process.

    python3 bench/slurm/slurm_trial.py HOWL [--cases 200] [--shards 16] [--config FILE] [--no-faults]

Starts a Slurm of its own (one_machine_slurm.sh) and ends it. While the shards run, two are requeued,
three cancelled, one is killed (-9), and the node's daemon is killed and started again; howl submit then
submits what is missing. Ends with 0 where the merged sheet, trial.json and the key are those of the one
process byte for byte, and with 77 where there is no Slurm. Without faults it also compares the time.
"""
import argparse
import filecmp
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
SAME = ["sheet.md", "trial.json", "seal.json", "key/key.json", "key/key.sealed"]
CONFIG = """experiments:
  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}
"""


def run(*words, check=True, **how):
    done = subprocess.run([str(word) for word in words], text=True, capture_output=True, **how)
    if check and done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, words))}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Faults:
    """What goes wrong while a job's shards run; each step waits for what it needs."""

    def __init__(self, job, shards, slurm_folder):
        self.job = job
        self.shards = shards
        self.slurm_folder = slurm_folder
        self.done = []

    def tasks(self, state):
        lines = run("squeue", "--noheader", "--array", f"--jobs={self.job}", "--format=%i %T").split("\n")
        return [line.split()[0] for line in lines if line.endswith(state)]

    def wait_for(self, state, count):
        for _ in range(600):
            tasks = self.tasks(state)
            if len(tasks) >= count:
                return tasks
            time.sleep(0.2)
        raise SystemExit(f"no {count} shards became {state}")

    def note(self, what):
        print(f"  fault: {what}", flush=True)
        self.done.append(what)

    def processes(self, task):
        mark = f"--shard\0{task.split('_')[1]}/{self.shards}\0".encode()
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (folder / "cmdline").read_bytes()
            except OSError:
                continue
            if mark in words:
                yield int(folder.name)

    def make(self):
        for task in self.wait_for("RUNNING", 2)[:2]:
            run("scontrol", "requeue", task)
            self.note(f"{task} requeued")
        for task in self.wait_for("PENDING", 5)[-3:]:
            run("scancel", task)
            self.note(f"{task} cancelled")
        while True:
            task = self.wait_for("RUNNING", 1)[0]
            found = list(self.processes(task))
            if found:
                break
            time.sleep(0.05)
        os.kill(found[0], signal.SIGKILL)
        self.note(f"{task} killed")
        self.wait_for("RUNNING", 1)
        os.kill(int((self.slurm_folder / "slurmd.pid").read_text()), signal.SIGKILL)
        time.sleep(1)
        run(HERE / "one_machine_slurm.sh", "node", self.slurm_folder)
        self.note("the node's daemon killed and started again")


def follow(howl, out):
    """Until nothing is in the queue; the exit status is 0 where no shard is missing."""
    return subprocess.run([howl, "status", out, "--follow", "--quiet"]).returncode


def submit(howl, job, out):
    text = run(howl, "submit", job, "--out", out)
    print("  " + text.split("\n")[0], flush=True)
    return re.search(r"as job (\d+)", text).group(1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("howl")
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--shards", type=int, default=16)
    parser.add_argument("--config")
    parser.add_argument("--options", default="--duration 0.85")
    parser.add_argument("--no-faults", action="store_true")
    how = parser.parse_args()
    howl = str(pathlib.Path(how.howl).resolve())
    if os.geteuid() != 0 or not all(map(shutil.which, ["slurmctld", "slurmd", "munged", "sbatch"])):
        print("needs slurm-wlm, munge and root: skipped")
        return 77
    folder = pathlib.Path(tempfile.mkdtemp(prefix="howl_slurm_"))
    slurm = folder / "slurm"
    os.environ["SLURM_CONF"] = str(slurm / "slurm.conf")
    config = folder / "rig.yaml"
    config.write_text(pathlib.Path(how.config).read_text() if how.config else CONFIG)
    words = f"trial rig.yaml --cases {how.cases} --seed 7 {how.options}"
    job = folder / "job.yaml"
    job.write_text(f"command: {words}\nshards: {how.shards}\n")
    try:
        start = time.time()
        run(howl, *words.split(), "--out", folder / "one", "--threads", os.cpu_count(), "--quiet", cwd=folder)
        plain_s = time.time() - start
        print(f"one process, {os.cpu_count()} threads: {plain_s:.1f} s", flush=True)
        run(HERE / "one_machine_slurm.sh", "start", slurm)
        out = folder / "many"
        start = time.time()
        number = submit(howl, job, out)
        if not how.no_faults:
            Faults(number, how.shards, slurm).make()
        submissions = 1
        while follow(howl, out) != 0 and submissions < 5:
            submit(howl, job, out)
            submissions += 1
        slurm_s = time.time() - start
        print(f"{how.shards} shards on Slurm: {slurm_s:.1f} s, {submissions} submissions; "
              f"{100 * (slurm_s / plain_s - 1):+.1f} % of the one process's time", flush=True)
        differ = [name for name in SAME if not filecmp.cmp(folder / "one" / name, out / name, shallow=False)]
        print("differ: " + ", ".join(differ) if differ else f"the same to the byte: {', '.join(SAME)}")
        return 1 if differ else 0
    finally:
        subprocess.run([HERE / "one_machine_slurm.sh", "stop", slurm])
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
