#!/usr/bin/env python3
"""How near the hot loops come to what the machine can do: the tables of docs/limits.md.

    limits.py BUILD_DIR [ROUNDS]     (needs valgrind and binutils; five minutes on an idle core)

build/bench/limits_study measures the machine's peaks and the workloads in turn on one thread, each
once a round; shares are taken within a round, and medians, least and greatest are over the rounds.
operations.py counts what a unit of each workload consists of.
"""
import json
import pathlib
import statistics
import subprocess
import sys

import operations

# What an instruction on so many lanes is measured against: the machine's widest, where the program
# has copies for it.
SUMS = {1: "multiply-add, scalar", 2: "multiply-add, 2 lanes (SSE2)",
        4: "multiply-add, 4 lanes (AVX2)", 8: "multiply-add, 8 lanes (AVX-512)"}
DIVISIONS = {1: "division, scalar", 2: "division, 2 lanes (SSE2)", 4: "division, 4 lanes (AVX2)",
             8: "division, 8 lanes (AVX-512)"}
# Calls without a peak of their own: the nearest kind.
LIKE = {"malloc": "384 bytes allocated and freed", "fesetround": "rounding mode switched",
        "sincos": "sin", "asin": "atan", "pow": "exp", "tanh": "exp"}


def median(values):
    return statistics.median(values)


def spread(values, form):
    return f"{form(median(values))} ({form(min(values))} .. {form(max(values))})"


def nanoseconds(seconds):
    ns = 1e9 * seconds
    return f"{ns:.3g}" if ns < 1000 else f"{ns:,.0f}"


def percent(share):
    return f"{100 * share:.0f} %" if share >= 0.095 else f"{100 * share:.2g} %"


class Machine:
    def __init__(self, peaks):
        self.seconds = {name: row["seconds_per_unit"] for name, row in peaks.items()}
        fastest = min((name for name in self.seconds if name.startswith("multiply-add")),
                      key=lambda name: median(self.seconds[name]))
        self.vector = fastest

    def of_lanes(self, names, lanes):
        """Seconds of an operation, by round."""
        return self.seconds[names[lanes] if names[lanes] in self.seconds else names[1]]

    def of_call(self, name):
        return self.seconds[LIKE.get(name, name)]


def parts(machine, counted, k):
    """Seconds a unit of each kind of work, in round k, were each done at the machine's peak."""
    out = {"sums and products": 0.0, "divisions and roots": 0.0, "library functions": 0.0,
           "rounding mode": 0.0, "allocation": 0.0}
    for (kind, lanes), number in counted["own"].items():
        if kind == "sum or product":
            out["sums and products"] += number * machine.of_lanes(SUMS, lanes)[k]
        else:
            out["divisions and roots"] += number * machine.of_lanes(DIVISIONS, lanes)[k]
    for name, number in counted["calls"].items():
        where = {"malloc": "allocation", "fesetround": "rounding mode"}.get(name,
                                                                           "library functions")
        out[where] += number * machine.of_call(name)[k]
    return out


def print_table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|---" * len(head) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def print_peaks(measured):
    rows = []
    for name, row in measured["peaks"].items():
        seconds = row["seconds_per_unit"]
        rate = [1e-9 / s for s in seconds]
        rows.append([name, row["unit"], spread(seconds, nanoseconds),
                     spread(rate, lambda r: f"{r:.3g}")])
    print_table(["machine", "unit", "ns a unit", "units, 10^9 a second"], rows)


def print_rates(measured, machine, counts):
    rows = []
    for name, row in measured["loads"].items():
        seconds, counted = row["seconds_per_unit"], counts[name]

        def share(work, peak):
            return spread([work * p / s for p, s in zip(machine.seconds[peak], seconds)], percent)
        rows.append([name, row["unit"], spread(seconds, nanoseconds),
                     f"{counted['all'] / median(seconds) / 1e9:.2g}",
                     share(counted["all"], SUMS[1]), share(counted["all"], machine.vector),
                     share(counted["memory"], "memory, triad")])
    print_table(["workload", "unit", "ns a unit", "10^9 operations a second",
                 "of the scalar peak", "of the vector peak", "of the bandwidth"], rows)


def print_counts(counts):
    rows = []
    for name, counted in counts.items():
        divided = sum(n for (kind, _), n in counted["own"].items() if kind != "sum or product")
        inside = counted["all"] - sum(counted["own"].values())
        calls = sorted(counted["calls"].items(), key=lambda call: -call[1])
        called = ", ".join(f"{n:,.3g} {call}" if n < 1000 else f"{n:,.0f} {call}"
                           for call, n in calls if n >= 0.005)
        rows.append([name, f"{counted['all']:,.0f}", f"{inside:,.0f}", f"{divided:,.0f}",
                     f"{counted['instructions']:,.0f}", f"{counted['beyond_first_cache']:,.0f}",
                     f"{counted['memory']:,.0f}", called or "-"])
    print_table(["workload", "operations a unit", "of these in the C library",
                 "divisions and roots", "instructions", "bytes beyond the first cache",
                 "bytes of memory", "calls"], rows)


def print_parts(measured, machine, counts):
    rows, head = [], None
    for name, row in measured["loads"].items():
        seconds = row["seconds_per_unit"]
        rounds = [parts(machine, counts[name], k) for k in range(len(seconds))]
        shares = {kind: median([r[kind] / s for r, s in zip(rounds, seconds)])
                  for kind in rounds[0]}
        total = [sum(r.values()) / s for r, s in zip(rounds, seconds)]
        head = head or ["workload", *shares, "together"]
        rows.append([name, *(percent(s) for s in shares.values()), spread(total, percent)])
    print_table(head, rows)


def main():
    study = pathlib.Path(sys.argv[1]) / "bench" / "limits_study"
    rounds = sys.argv[2] if len(sys.argv) > 2 else "15"
    measured = json.loads(subprocess.run([study, rounds], capture_output=True, text=True,
                                         check=True).stdout)
    machine = Machine(measured["peaks"])
    counts = {name: operations.count(str(study), name) for name in measured["loads"]}
    print(f"{rounds} rounds; median (least .. greatest). Vector peak: {machine.vector}\n")
    print_peaks(measured)
    print_rates(measured, machine, counts)
    print_counts(counts)
    print_parts(measured, machine, counts)


if __name__ == "__main__":
    main()
