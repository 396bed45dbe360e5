#!/usr/bin/env python3
"""Asks every command the same question about loops that are known exactly.

    property_study.py HOWL [--problems 200] [--first 0] [--jobs 2] [--without-diagnosis]
                      [--store FOLDER]

For each drawn problem (one or two modes, a shared delay or one for each experiment): fit and family on
the exact table; simulate the drawn loop, its parameters held; analyse, fit, family and diagnose on the
simulated records, with the config that simulate wrote, its parameters free again. Counted are: empty
families, guaranteed bounds that the truth leaves, 95 % intervals that hold it, and diagnoses that
accuse. Exit status 1 where a guarantee fails or a share is less than its binomial scatter allows.

With --store each problem's counts stay in the folder, and a study that was stopped goes on from there;
a folder belongs to one program and one kind of study.
"""

import argparse
import copy
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

import problem as problems

Z95 = 1.96
PARAMETERS = ("omega_hz", "xi", "N", "M", "tau_s")


class Tally:
    """Successes out of trials by name, with what failed."""

    def __init__(self):
        self.counts = {}
        self.failures = []

    def add(self, name, good, note=""):
        done, right = self.counts.get(name, (0, 0))
        self.counts[name] = (done + 1, right + (1 if good else 0))
        if not good and note:
            self.failures.append(f"{name}: {note}")

    def merge(self, other):
        for name, (done, right) in other.counts.items():
            mine = self.counts.get(name, (0, 0))
            self.counts[name] = (mine[0] + done, mine[1] + right)
        self.failures += other.failures


def run(howl, *arguments):
    return subprocess.run([howl, *map(str, arguments), "--threads", "1"], capture_output=True,
                          text=True, check=False)


def check_bounds(tally, prefix, folder, truths, note):
    """No member lies outside `outer`, so a truth that passes the test lies inside."""
    with open(folder / "family.json", encoding="utf-8") as file:
        bounds = json.load(file)["bounds"]
    for loop in truths:
        for name, bound in bounds.get(loop.name, {}).items():
            value = loop.loop_gain if name == "loop_gain" else getattr(loop, name, None)
            if value is None:
                continue
            low = -math.inf if bound["outer"][0] is None else bound["outer"][0]
            high = math.inf if bound["outer"][1] is None else bound["outer"][1]
            slack = 1e-9 * abs(value)  # of the numbers' text
            tally.add(f"{prefix} bound holds {name}", low - slack <= value <= high + slack,
                      f"{note} {loop.name} {value:.6g} not in {low:.6g} .. {high:.6g}")


def check_fit_intervals(tally, prefix, folder, truths, note):
    with open(folder / "solution.json", encoding="utf-8") as file:
        solution = json.load(file)
    true_of = {loop.name: loop for loop in truths}
    for parameter in solution["parameters"]:
        owner, _, name = parameter["name"].rpartition(".")
        if parameter["fixed"] or parameter["std_relative"] is None or name.endswith("_mean"):
            continue
        loop = true_of[owner] if owner else truths[0]
        true = loop.M / loop.N if name == "M_over_N" else getattr(loop, name)
        error = math.log(parameter["value"] / true)
        tally.add(f"{prefix} interval of {name}", abs(error) <= Z95 * parameter["std_relative"],
                  f"{note} {parameter['name']} {parameter['value']:.6g} for {true:.6g},"
                  f" {error / parameter['std_relative']:.1f} std")


def check_characteristics(tally, folder, truths, note):
    with open(folder / "characteristics.csv", encoding="utf-8") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    for loop in truths:
        row = rows[loop.name]
        if not row["phase_deg"]:
            tally.add("analyse sees the cycle", False, f"{note} {loop.name}")
            continue
        tally.add("analyse sees the cycle", True)
        frequency = float(row["frequency_hz"])
        response = loop.acoustics(frequency)
        true = {"phase": (math.degrees(problems.cmath.phase(response)), "phase_deg",
                          "phase_std_deg"),
                "gain": (abs(response), "gain", "gain_std"),
                "frequency": (loop.frequency_hz, "frequency_hz", "frequency_std_hz")}
        for name, (value, column, std_column) in true.items():
            if not row.get(column) or not row.get(std_column):
                continue
            std = float(row[std_column])
            error = float(row[column]) - value
            tally.add(f"analyse interval of {name}", abs(error) <= Z95 * std,
                      f"{note} {loop.name} {float(row[column]):.6g} for {value:.6g},"
                      f" {error / std if std else math.inf:.1f} std")
        if row["loop_gain"] and row["flame_slope_std"]:
            measured = float(row["loop_gain"])
            std = measured * math.hypot(float(row["flame_slope_std"]) / float(row["flame_slope"]),
                                        float(row["gain_std"]) / float(row["gain"]))
            tally.add("analyse interval of loop gain", abs(measured - loop.loop_gain) <= Z95 * std,
                      f"{note} {loop.name} {measured:.6g} for {loop.loop_gain:.6g},"
                      f" {(measured - loop.loop_gain) / std:.1f} std")


def at_the_cycle(drawn):
    """The drawn loops as records show them: at the cycle's frequency, which harmonics shift."""
    truths = []
    for loop in drawn.loops:
        frequency = problems.cycle_frequency_hz(loop)
        true = copy.copy(loop)
        true.loop_gain *= (frequency * abs(loop.acoustics(frequency))
                           / (loop.frequency_hz * loop.gain()))
        true.frequency_hz = frequency
        truths.append(true)
    return truths


def with_free_parameters(records, drawn):
    """simulate's own config holds what was drawn; what is asked of its records does not."""
    lines = records.read_text(encoding="utf-8").split("\n")
    kept = [line for line in lines if line and not line.startswith("parameters:")]
    assert len(kept) < len(lines) - 1, "simulate's records.yaml has no line of parameters"
    records.write_text("\n".join(kept) + "\n" + problems.free_parameters(drawn), encoding="utf-8")


def study(howl, seed, with_diagnosis):
    tally = Tally()
    drawn = problems.draw(seed)
    note = f"problem {seed} ({drawn.modes} modes, {'shared' if drawn.shared_delay else 'own'} tau)"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        config = folder / "problem.yaml"
        config.write_text(problems.config_text(drawn, problems.free_parameters(drawn)),
                          encoding="utf-8")
        held = folder / "held.yaml"
        held.write_text(problems.config_text(drawn, problems.held_parameters(drawn)),
                        encoding="utf-8")
        table, rig = folder / "table", folder / "rig"
        fit = run(howl, "fit", config, "--out", table)
        tally.add("table: fit converges", fit.returncode == 0, f"{note} {fit.stderr.strip()}")
        family = run(howl, "family", config, "--out", table)
        tally.add("table: family has members", family.returncode == 0,
                  f"{note} {family.stderr.strip()} {family.stdout[:200]}")
        if family.returncode in (0, 1):
            check_bounds(tally, "table:", table, drawn.loops, note)
        simulate = run(howl, "simulate", held, "--out", rig, "--seed", seed + 1)
        if simulate.returncode != 0:
            tally.add("simulate", False, f"{note} {simulate.stderr.strip()}")
            return tally
        tally.add("records: stay on the drawn cycle", "has left its cycle" not in simulate.stdout,
                  f"{note} {simulate.stdout[-200:]}")
        truths = at_the_cycle(drawn)
        records = rig / "records.yaml"
        with_free_parameters(records, drawn)
        analyse = run(howl, "analyse", records, "--out", rig)
        tally.add("records: analyse", analyse.returncode == 0, f"{note} {analyse.stderr.strip()}")
        check_characteristics(tally, rig, truths, note)
        fit = run(howl, "fit", records, "--out", rig)
        tally.add("records: fit converges", fit.returncode == 0,
                  f"{note} {fit.stderr.strip()} {fit.stdout[-300:]}")
        if (rig / "solution.json").exists():
            check_fit_intervals(tally, "records: fit", rig, truths, note)
        family = run(howl, "family", records, "--out", rig)
        tally.add("records: family has members", family.returncode == 0,
                  f"{note} {family.stderr.strip()} {family.stdout[:400]}")
        if (rig / "family.json").exists():
            check_bounds(tally, "records:", rig, truths, note)
        if with_diagnosis:
            diagnose = run(howl, "diagnose", records, "--out", rig)
            verdict = {"kind": "failed: " + diagnose.stderr.strip(), "effect": None}
            if diagnose.returncode == 0:
                with open(rig / "diagnosis.json", encoding="utf-8") as file:
                    verdict = json.load(file)["verdict"]
            tally.add("records: diagnosis accuses nothing", verdict["kind"] == "none",
                      f"{note} {verdict['kind']} {verdict['effect']}")
    return tally


def stored_study(options, seed):
    """A study's counts: of the folder if it has them, and put there if not."""
    path = pathlib.Path(options.store) / f"{seed:03d}.json" if options.store else None
    tally = Tally()
    if path and path.exists():
        stored = json.loads(path.read_text(encoding="utf-8"))
        tally.counts = {name: tuple(count) for name, count in stored["counts"].items()}
        tally.failures = stored["failures"]
        return tally
    started = time.monotonic()
    tally = study(options.howl, seed, not options.without_diagnosis)
    print(f"problem {seed}: {time.monotonic() - started:.0f} s", *tally.failures, sep="\n  ",
          file=sys.stderr, flush=True)
    if path:
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(".part")
        part.write_text(json.dumps({"counts": tally.counts, "failures": tally.failures}),
                        encoding="utf-8")
        part.replace(path)
    return tally


def required_share(name):
    """Guarantees hold always; 95 % intervals and 5 % false alarms at their rate."""
    return 0.95 if "interval" in name or "diagnosis" in name else 1.0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("howl")
    parser.add_argument("--problems", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--without-diagnosis", action="store_true")
    parser.add_argument("--store", help="folder of one file for each problem")
    options = parser.parse_args()
    total = Tally()
    seeds = range(options.first, options.first + options.problems)
    with ThreadPoolExecutor(options.jobs) as pool:
        for one in pool.map(lambda seed: stored_study(options, seed), seeds):
            total.merge(one)
    failed = False
    for name, (done, right) in sorted(total.counts.items()):
        share = required_share(name)
        # Three standard deviations of the binomial count below what is stated.
        least = share * done - 3.0 * math.sqrt(done * share * (1.0 - share))
        bad = right < least
        failed = failed or bad
        print(f"{right:6d} of {done:6d}  {100.0 * right / done:6.1f} %  {name}"
              f"{'   <- FAILS' if bad else ''}")
    for failure in total.failures:
        print("  " + failure)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
