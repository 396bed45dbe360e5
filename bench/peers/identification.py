"""Identification of a self-excited loop from records, and its limit cycle on held-out data.

Peer: a discrete-time, time-delayed Lur'e model (lure.py), which sees p alone. howl sees p and q, fits
its grey box, takes the measured flame, and simulates. Both take the first half of each record; the
frequency and amplitude of p in a free run without noise are compared with the second half.
Records of two simulators: howl's own (R228's loop, noise as it comes), whose model class is howl's,
and howl_rig's (travelling waves in a duct), which has neither program's.
"""
import pathlib
import tempfile

import numpy as np

from common import SOURCE, timed
from lure import identify, line
from rigs import SAMPLING_HZ, make

NAME = "Identification"
ORDERS, DELAYS = (2, 4, 6, 8), range(6, 25, 2)


def own_records(howl, folder):
    howl.run("simulate", str(SOURCE / "configs/r228.yaml"), folder)
    return {f"exp{k}": folder / f"exp{k}.csv" for k in range(1, 7)}


def rig_records(howl, folder, seed):
    make(howl, folder, None, 0.0, seed)
    return {path.stem: path for path in sorted((folder / "data").glob("*.csv"))}


def split(files, folder):
    """First halves as files for howl; p of both halves."""
    parts = {}
    for name, path in files.items():
        rows = np.loadtxt(path, delimiter=",", skiprows=1)
        half = len(rows) // 2
        np.savetxt(folder / f"{name}.csv", rows[:half], delimiter=",", header="p,q", comments="",
                   fmt="%.9g")
        parts[name] = rows[:half, 0], rows[half:, 0]
    return parts


def howl_lines(howl, names, folder, phi):
    """Lines of howl's free runs, after a fit to the first halves."""
    lines = ["experiments:"] + [
        f"  - {{name: {name}, phi: {phi[name]}, record: {{file: {name}.csv, pressure: p, "
        f"heat_release: q, sampling_hz: {SAMPLING_HZ}}}}}" for name in names]
    lines.append("simulate: {combustion_noise_relative: 0, sensor_noise_relative: 0}")
    (folder / "config.yaml").write_text("\n".join(lines) + "\n")
    howl.run("simulate", str(folder / "config.yaml"), folder / "out")
    return {name: line(np.loadtxt(folder / "out" / f"{name}.csv", delimiter=",", skiprows=1)[:, 0],
                       SAMPLING_HZ) for name in names}


def lure_lines(parts):
    found = {}
    for name, (first, _) in parts.items():
        model = identify(first, SAMPLING_HZ, ORDERS, DELAYS)
        run = None if model is None else model.free_run(first, 3 * SAMPLING_HZ)
        found[name] = (np.nan, np.nan) if run is None else line(run[SAMPLING_HZ:], SAMPLING_HZ)
    return found


def compare(howl, table, quick):
    phi = {f"exp{k}": value for k, value in zip(range(1, 7), (.56, .53, .51, .49, .47, .45))}
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "own").mkdir()
        sets = {"R228 simulated by howl": [own_records(howl, root / "own")]}
        sets["rigs by howl_rig"] = [rig_records(howl, root / f"rig{seed}", 700 + seed)
                                    for seed in range(1 if quick else 5)]
        for title, groups in sets.items():
            compare_set(howl, table, title, groups, root, phi)


def compare_set(howl, table, title, groups, root, phi):
    names = ("howl", "time-delayed Lur'e")
    misses = {name: [] for name in names}
    seconds = {name: [] for name in names}
    spread_within = []
    for number, files in enumerate(groups):
        folder = root / f"{title.split()[0]}_{number}_halves"
        folder.mkdir()
        parts = split(files, folder)
        runs = {"howl": timed(lambda: howl_lines(howl, list(files), folder, phi)),
                "time-delayed Lur'e": timed(lambda: lure_lines(parts))}
        for program, run in runs.items():
            seconds[program].append(run.cpu_s / len(files))
            for name, (first, second) in parts.items():
                wanted = line(second, SAMPLING_HZ)
                misses[program].append([run.value[name][0] / wanted[0] - 1,
                                        run.value[name][1] / wanted[1] - 1])
        spread_within += [[a / b - 1 for a, b in zip(line(first, SAMPLING_HZ),
                                                     line(second, SAMPLING_HZ))]
                          for first, second in parts.values()]
    halves = 100 * np.median(np.abs(spread_within), axis=0)
    for which, quantity in enumerate(("frequency", "amplitude")):
        values = {n: 100 * np.abs(np.array(misses[n])[:, which]) for n in names}
        lost = int(np.sum(~np.isfinite(values[names[1]])))
        table.add(NAME, f"{title}: error of the free run's {quantity} on held-out halves, %",
                  "lower", list(values["howl"]), names[1],
                  [v for v in values[names[1]] if np.isfinite(v)],
                  f"{len(values['howl'])} records; the halves differ by {halves[which]:.2g} %"
                  + (f"; {lost} without a bounded free run" if lost else ""))
    table.add(NAME, f"{title}: CPU s a record", "lower", seconds["howl"], names[1],
              seconds[names[1]], "peer in numpy, a grid of orders and delays")
