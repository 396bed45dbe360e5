#!/usr/bin/env python3
"""The tables of docs/faults.md: what howl says to faults and to hostile input.

    fault_table.py HOWL PROJECT [--update]

Brings about each fault and compares what the program says, and its exit status, with the page; --update
writes it there. Faults that need a right that this user has not (to mount a file system) keep their row,
saying so. Exit status 1 where a row differs.
"""

import argparse
import fcntl
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

RIG = """experiments:
  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}
  - {name: exp2, phi: 0.60, frequency_hz: 214, phase_deg: -10, gain: 11}
"""
RECORD = ("experiments: [{{name: e1, phi: 0.5, record: {{file: {}, pressure: p, heat_release: q, "
          "sampling_hz: 5000}}}}]\n")
MARK = "<!-- {} -->"


class Place:
    """A folder of its own for one fault."""

    def __init__(self, howl, project, folder):
        self.howl, self.project, self.folder = howl, project, folder
        self.write("rig.yaml", RIG)

    def write(self, name, content):
        data = content if isinstance(content, bytes) else content.encode()
        (self.folder / name).write_bytes(data)

    def corpus(self, name):
        return (self.project / "tests/fuzz/corpus" / name).read_bytes()

    def shell(self, line):
        line = line.replace("howl ", f"{self.howl} ", 1) if line.startswith("howl ") else line.replace(
            "; howl ", f"; {self.howl} ")
        done = subprocess.run(["bash", "-c", line], cwd=self.folder, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL)
        return done.returncode, done.stderr

    def rig(self, **changes):
        """The first experiment of the small problem with other values."""
        text = RIG.splitlines()[1]
        for key, value in changes.items():
            text = re.sub(rf"{key}: [^,}}]+", lambda _, k=key, v=value: f"{k}: {v}", text)
        self.write("rig.yaml", f"experiments:\n{text}\n")
        return self.shell("howl fit rig.yaml --out out")

    def record(self, name, content):
        self.write(name, content)
        self.write("rig.yaml", RECORD.format(name))
        return self.shell("howl analyse rig.yaml --out out")


def rows(count=40):
    return "p,q\n" + "".join(f"{(7 * i) % 11 - 5},{(5 * i) % 13 - 6}\n" for i in range(count))


def another_run(place):
    (place.folder / "out").mkdir()
    with open(place.folder / "out/.howl.lock", "w", encoding="utf-8") as lock:
        lock.write("howl family, process 4711")
        lock.flush()
        fcntl.flock(lock, fcntl.LOCK_EX)
        return place.shell("howl fit rig.yaml --out out")


def ctrl_c(place):
    run = subprocess.Popen([place.howl, "family", place.project / "configs/r228_two_modes.yaml", "--out",
                            "out", "--save-every", "0.01", "--threads", "1", "--quiet"],
                           cwd=place.folder, stderr=subprocess.PIPE, text=True)
    while not (place.folder / "out/bounds.state").exists() and run.poll() is None:
        time.sleep(0.02)
    run.send_signal(2)
    said = run.communicate()[1]
    return run.returncode, said


def full_disk(place):
    disk = place.folder / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=4k", "tmpfs", str(disk)]
    if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
        return None
    try:
        return place.shell("howl fit rig.yaml --out disk/out")
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def read_only(place):
    (place.folder / "out").mkdir(mode=0o555)
    place.folder.chmod(0o755)
    user = "setpriv --reuid=65534 --regid=65534 --clear-groups " if os.geteuid() == 0 else ""
    if place.shell(f"{user}{place.howl} --version")[0] != 0:
        return None
    return place.shell(f"{user}{place.howl} fit rig.yaml --out out")


def little_memory(place):
    for megabytes in range(40, 200, 2):
        # Threads of OpenBLAS, where that is the linear algebra, ask for memory until it is given.
        said = place.shell(f"ulimit -v {megabytes}000; export OPENBLAS_NUM_THREADS=1; "
                           "howl fit rig.yaml --threads 1 --out out")
        if said[0] == 2 and said[1].startswith("rig.yaml"):
            return said
    return None


def aliases(place):
    text = "a: &a [x, x, x, x, x, x, x, x, x, x]\n"
    for i in range(1, 26):
        text += f"{chr(97 + i)}: &{chr(97 + i)} [{', '.join(['*' + chr(96 + i)] * 10)}]\n"
    place.write("rig.yaml", text)
    return place.shell("howl analyse rig.yaml --out out")


def axes(place):
    place.write("rig.yaml", "config: rig.yaml\ngrid:\n" + "".join(
        f"  experiments[0].{key}: {{from: 1, to: 100000}}\n" for key in ("gain", "phase_deg")))
    return place.shell("howl campaign rig.yaml --out out")


def long_template(place):
    place.write("long.yaml", RIG + ("# " + "x" * 200_000 + "\n") * 15)
    place.write("rig.yaml", "config: long.yaml\ngrid: {seed: {from: 1, to: 100000}}\n")
    return place.shell("howl campaign rig.yaml --out out")


def fleet(place):
    place.write("long.yaml", RIG)
    place.write("rig.yaml", "config: long.yaml\nfleet: /dev/zero\n")
    return place.shell("howl campaign rig.yaml --out out")


def endless_job(place):
    (place.folder / "out/shards").mkdir(parents=True)
    place.write("out/shards/job.json", place.corpus("submitted/shards_without_end"))
    return place.shell("howl status out")


def nested_results(place):
    place.write("reference.json", '{"schema": "howl.reference/2", "solution": ' + "[" * 300_000 + "]" * 300_000 + "}")
    return place.shell("ulimit -c 0; howl regress rig.yaml --reference . --out out")


def text_config(place, text):
    place.write("rig.yaml", text)
    return place.shell("howl analyse rig.yaml --out out")


def mat_dimensions(place):
    data = bytearray(place.corpus("mat5/plain"))
    at = data.index((40).to_bytes(4, "little"))
    data[at:at + 4] = (60).to_bytes(4, "little")
    return place.record("r.mat", bytes(data))


FAULTS = [
    ("another run writes to the output folder", another_run),
    ("the output folder cannot be made", lambda p: p.shell("howl fit rig.yaml --out rig.yaml/out")),
    ("the output folder cannot be written", read_only),
    ("the disk is full", full_disk),
    ("a file may not grow (quota)", lambda p: p.shell("ulimit -f 4; howl simulate rig.yaml --out out")),
    ("standard output is a full device", lambda p: p.shell("howl fit rig.yaml --out out >/dev/full")),
    ("standard output is closed", lambda p: p.shell("howl fit rig.yaml --out out >&-")),
    ("too little memory", little_memory),
    ("too few descriptors", lambda p: p.shell("ulimit -n 4; howl fit rig.yaml --out out")),
    ("Ctrl-C in a search for bounds", ctrl_c),
    ("a record is not there", lambda p: text_config(p, RECORD.format("gone.csv"))),
    ("a record is empty", lambda p: p.record("r.csv", "")),
    ("a record ends inside a row", lambda p: p.record("r.csv", rows() + "3")),
    ("a gzip record is cut", lambda p: p.record("r.csv.gz", gzip.compress(rows().encode())[:-30])),
    ("a gzip record is damaged",
     lambda p: p.record("r.csv.gz", gzip.compress(rows().encode())[:20] + b"\xff" * 40)),
    ("a MATLAB record is cut", lambda p: p.record("r.mat", p.corpus("mat5/plain")[:600])),
    ("a MATLAB record's dimensions are not its numbers'", mat_dimensions),
    ("an HDF5 record is cut", lambda p: p.record("r.h5", p.corpus("hdf5/plain")[:1500])),
    ("an HDF5 record divides the library by zero",
     lambda p: p.record("r.h5", p.corpus("hdf5/chunk_of_no_size"))),
]
HOSTILE = [
    ("a name that is a path", lambda p: p.rig(name='"../up"')),
    ("a name with a control character", lambda p: p.rig(name='"e\\e[2J"')),
    ("a text with half a pair of UTF-16", lambda p: text_config(p, b"title: \xed\xa0\x80\n")),
    ("a name with a variable of the environment", lambda p: p.rig(name='"${HOME}"')),
    ("a name that is a file of results", lambda p: p.rig(name="family")),
    ("a number out of range", lambda p: p.rig(gain="1e300")),
    ("a variable in a record's path that is not set",
     lambda p: text_config(p, RECORD.format('"${HOWL_NOT_SET}/r.csv"'))),
    ("aliases of aliases", aliases),
    ("aliases of one long text", lambda p: text_config(
        p, "a: &a " + "x" * 4000 + "\nb:\n" + ("  - [" + "*a," * 40_000 + "]\n") * 3)),
    ("a mapping of 60000 keys",
     lambda p: text_config(p, "effects:\n" + "".join(f"  k{i}: 1\n" for i in range(60_000)))),
    ("a grid of a hundred thousand values on each axis", axes),
    ("a campaign whose configs take 300 GB", long_template),
    ("a campaign's table that is a device", fleet),
    ("a submitted job of 10^15 shards", endless_job),
    ("lists in lists", lambda p: text_config(p, "experiments: " + "[" * 1000 + "]" * 1000)),
    ("one very long line", lambda p: text_config(p, "title: " + "x" * 1_000_000)),
    ("a config of 30 MB", lambda p: text_config(p, "\n" * 30_000_000)),
    ("a record in place of the config", lambda p: text_config(p, rows())),
    ("a gzip file that unpacks to 300 MB",
     lambda p: p.record("r.csv.gz", gzip.compress(b"p,q\n" + b"1,2\n" * 75_000_000, 6))),
    ("one line of ten million columns", lambda p: p.record("r.csv", "1" + ",1" * 10_000_000 + "\n")),
    ("rows of a hundred thousand columns", lambda p: p.record("r.csv", ("1" + ",1" * 99_999 + "\n") * 40)),
    ("stored results of 300000 lists in one another", nested_results),
    ("an HDF5 file of 800 MB of which nothing is stored",
     lambda p: p.record("r.h5", p.corpus("hdf5/nothing_stored"))),
    ("an executable in place of a record",
     lambda p: p.record("r.csv", pathlib.Path("/bin/true").read_bytes())),
    ("one sample out of range", lambda p: p.record("r.csv", rows() + "1e160,2\n")),
]


def row(howl, project, what, fault):
    """The row of the table; None where the fault cannot be brought about here."""
    folder = pathlib.Path(tempfile.mkdtemp())
    try:
        answer = fault(Place(howl, project, folder))
    finally:
        shutil.rmtree(folder)
    if answer is None:
        return None
    status, said = answer
    said = said.strip().replace(f"{folder}/", "").replace(str(folder), ".").replace("\n", " / ")
    quote = "``" if "`" in said else "`"
    return f"| {what} | {status} | {quote}{said}{quote} |" if said else f"| {what} | {status} | |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("howl")
    parser.add_argument("project")
    parser.add_argument("--update", action="store_true")
    asked = parser.parse_args()
    howl, project = str(pathlib.Path(asked.howl).resolve()), pathlib.Path(asked.project).resolve()
    page = project / "docs/faults.md"
    lines = page.read_text(encoding="utf-8").split("\n")
    wrong = 0
    for name, faults in (("faults", FAULTS), ("hostile", HOSTILE)):
        begin = lines.index(MARK.format(name)) + 3  # behind the table's head
        end = lines.index("", begin)
        shown = lines[begin:end]
        made = []
        for what, fault in faults:
            here = row(howl, project, what, fault)
            stored = next((line for line in shown if line.startswith(f"| {what} |")), None)
            if here is None:
                print(f"passed over: {what}: cannot be brought about here")
                here = stored or f"| {what} | | |"
            elif here != stored and not asked.update:
                print(f"shown: {stored}\nsaid:  {here}")
                wrong += 1
            made.append(here)
        if not asked.update and [line.split("|")[1] for line in shown] != [
                line.split("|")[1] for line in made]:
            print(f"the table {name} has other rows than the test")
            wrong += 1
        lines[begin:end] = made
    if asked.update:
        page.write_text("\n".join(lines), encoding="utf-8")
    print(f"{len(FAULTS) + len(HOSTILE)} faults, {wrong} not as the page has them")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
