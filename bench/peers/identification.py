"""Identification of a self-excited loop from records, and its limit cycle on held-out data.

Peer: a discrete-time, time-delayed Lur'e model (lure.py), which sees p alone. howl sees p and q, fits
its grey box, takes the measured flame, and simulates. Both take the first half of each record; the
frequency and amplitude of p in a free run without noise are compared with the second half, and the
acoustic mode that each has found (the peer's: its nearest pair of poles) with the simulated one.
Records of two simulators: howl's own (R228's loop, noise as it comes), whose model class is howl's,
and howl_rig's (travelling waves in a duct), which has neither program's.
"""
import json
import pathlib
import tempfile

import numpy as np

import r228
from common import SOURCE, timed
from lure import identify, line
from rigs import SAMPLING_HZ, make

NAME = "Identification"
PEER = "time-delayed Lur'e"
QUANTITIES = ["the free run's frequency against the held-out half",
              "the free run's amplitude against the held-out half",
              "the acoustic mode's natural frequency against the truth",
              "its damping ratio against the truth"]
ORDERS, DELAYS = (2, 4, 6, 8), range(6, 25, 2)


def own_records(howl, folder):
    """{name: (record, true omega_hz, true xi)}."""
    config = str(SOURCE / "configs/r228.yaml")
    howl.run("simulate", config, folder)
    fitted = howl.answer("fit", config, "solution.json")["experiments"]
    return {e["name"]: (folder / f"{e['name']}.csv", e["omega_hz"], e["xi"]) for e in fitted}


def rig_records(howl, folder, seed):
    make(howl, folder, None, 0.0, seed)
    key = json.loads((folder / "key.json").read_text())
    return {e["name"]: (folder / "data" / f"{e['name']}.csv", e["omega_hz"], e["xi"])
            for e in key["experiments"]}


def split(files, folder):
    """First halves as files for howl; p of both halves."""
    parts = {}
    for name, (path, *_) in files.items():
        rows = np.loadtxt(path, delimiter=",", skiprows=1)
        half = len(rows) // 2
        np.savetxt(folder / f"{name}.csv", rows[:half], delimiter=",", header="p,q", comments="",
                   fmt="%.9g")
        parts[name] = rows[:half, 0], rows[half:, 0]
    return parts


def howl_found(howl, names, folder):
    """{name: (line's frequency and amplitude in a free run, omega_hz, xi)} from the first halves."""
    phi = dict(zip(r228.NAMES, r228.PHI))
    lines = ["experiments:"] + [
        f"  - {{name: {name}, phi: {phi[name]}, record: {{file: {name}.csv, pressure: p, "
        f"heat_release: q, sampling_hz: {SAMPLING_HZ}}}}}" for name in names]
    lines.append("simulate: {combustion_noise_relative: 0, sensor_noise_relative: 0}")
    config = folder / "config.yaml"
    config.write_text("\n".join(lines) + "\n")
    howl.run("simulate", str(config), folder / "out")
    howl.run("fit", str(config), folder / "out")
    fitted = json.loads((folder / "out" / "solution.json").read_text())["experiments"]
    read = lambda name: np.loadtxt(folder / "out" / f"{name}.csv", delimiter=",", skiprows=1)[:, 0]
    return {e["name"]: (*line(read(e["name"]), SAMPLING_HZ), e["omega_hz"], e["xi"])
            for e in fitted}


def lure_found(parts):
    found = {}
    for name, (first, _) in parts.items():
        model = identify(first, SAMPLING_HZ, ORDERS, DELAYS)
        run = None if model is None else model.free_run(first, 3 * SAMPLING_HZ)
        found[name] = (np.nan,) * 4 if run is None else (
            *line(run[SAMPLING_HZ:], SAMPLING_HZ),
            *model.mode(SAMPLING_HZ, line(first, SAMPLING_HZ)[0]))
    return found


def compare(howl, table, quick):
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        sets = {"R228 simulated by howl": [own_records(howl, root / "own")],
                "rigs by howl_rig": [rig_records(howl, root / f"rig{seed}", 700 + seed)
                                     for seed in range(1 if quick else 5)]}
        for title, groups in sets.items():
            compare_set(howl, table, title, groups, root)


def compare_set(howl, table, title, groups, root):
    misses = {"howl": [], PEER: []}
    seconds = {"howl": [], PEER: []}
    halves = []
    for number, files in enumerate(groups):
        folder = root / f"{title.split()[0]}_{number}_halves"
        folder.mkdir()
        parts = split(files, folder)
        runs = {"howl": timed(lambda: howl_found(howl, list(files), folder)),
                PEER: timed(lambda: lure_found(parts))}
        for name, (first, second) in parts.items():
            wanted = np.array([*line(second, SAMPLING_HZ), *files[name][1:]])
            halves.append(np.array(line(first, SAMPLING_HZ)) / wanted[:2] - 1)
            for program, run in runs.items():
                misses[program].append(np.array(run.value[name]) / wanted - 1)
        for program, run in runs.items():
            seconds[program].append(run.cpu_s / len(files))
    between = 100 * np.median(np.abs(halves), axis=0)
    for which, quantity in enumerate(QUANTITIES):
        ours, theirs = (100 * np.abs(np.array(misses[n])[:, which]) for n in misses)
        note = f"{len(ours)} records"
        if which < 2:
            note += f"; the halves themselves differ by {between[which]:.2g} %"
        lost = int(np.sum(~np.isfinite(theirs)))
        note += f"; {lost} without a bounded free run or an oscillating pole" if lost else ""
        table.add(NAME, f"{title}: error of {quantity}, %", "lower", list(ours), PEER,
                  list(theirs[np.isfinite(theirs)]), note)
    table.add(NAME, f"{title}: CPU s a record", "lower", seconds["howl"], PEER, seconds[PEER],
              "peer in numpy, over its grid of orders and delays")
