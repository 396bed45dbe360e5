"""Bounds of every parameter of the family, against codac (interval contractors) and optimisers.

Enclosures: howl; codac 2, set inversion by bisection (SIVIA) and best first, both with forward and
backward contractors to a fixed point, and with the phase of G as a variable of its own, since that
lets the contractors work far better than on the bare equations.
Inner only: SLSQP (scipy) and IPOPT (CasADi, exact derivatives) push every parameter both ways.

Excess: how much wider an enclosure is than the range that howl's members reach, over that range. No
enclosure can have less than none, if howl's members are members, which is checked here.
"""
import pathlib
import re
import tempfile

import numpy as np

from common import in_turns
from enclosures import best_first, sivia
from inner_bounds import ipopt, slsqp
from membership import ALL, bounds_of, config

NAME = "Bounds of the family"
PROBLEMS = {"one experiment, 4 parameters": (0,), "two experiments, 8 parameters": (0, 5),
            "R228, 24 parameters": ALL}
BUDGETS_S = ((3, 5), (30, 1))  # CPU seconds, and repeats


def excess(outer, inner):
    return np.array([(outer[key][1] - outer[key][0]) / (inner[key][1] - inner[key][0]) - 1
                     for key in inner])


def percent(values):
    return f"{100 * np.median(values):.3g} % median, {100 * np.max(values):.3g} % largest"


def compare(howl, table, quick):
    for title, which in PROBLEMS.items():
        enclose(howl, table, title, which, quick)
    push(howl, table, quick)


def howl_bounds(howl, which):
    return howl.answer("family", config(which), "family.json")


def alone_seconds(howl, which):
    """Wall seconds of the search for the bounds alone: from the times of the lines that the program
    writes as it ends each of them, the first of which has no beginning and counts as the mean."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "config.yaml"
        path.write_text(config(which))
        log = howl.run("family", path, folder, "--v", "2").stderr
    times = [float(m[1]) * 3600 + float(m[2]) * 60 + float(m[3]) for m in re.finditer(
        r"^I\d+ (\d+):(\d+):([\d.]+) .*bound_step", log, re.MULTILINE)]
    return (times[-1] - times[0]) % 86400 * len(times) / (len(times) - 1)


def enclose(howl, table, title, which, quick):
    answer = howl_bounds(howl, which)
    inner, outer = (bounds_of(answer, which, kind) for kind in ("inner", "outer"))
    ours = excess(outer, inner)
    for budget, repeats in ((1, 1),) if quick else BUDGETS_S:
        runs = in_turns(repeats, {
            "alone": lambda: alone_seconds(howl, which),
            "howl": lambda: howl_bounds(howl, which),
            "codac, SIVIA": lambda: sivia(which, budget),
            "codac, best first": lambda: best_first(which, budget, inner)})
        for name in list(runs)[2:]:
            theirs, boxes = runs[name][-1].value
            gap = excess(theirs, inner)
            if np.min(gap) < -1e-9:
                raise RuntimeError(f"{name}: a member of howl's lies outside, {theirs}, {inner}")
            what = f"{title}, codac for {budget} s"
            table.add(NAME, f"{what}: largest excess of an enclosure", "lower",
                      float(np.max(ours)), name, float(np.max(gap)),
                      f"howl {percent(ours)}; codac {percent(gap)}, stopped at {boxes} boxes")
            seconds = [r.cpu_s for r in runs[name]]
            table.add(NAME, f"{what}: CPU s, howl's bounds alone", "lower",
                      [r.value for r in runs["alone"]], name, seconds, "howl's are wall seconds")
            table.add(NAME, f"{what}: CPU s, howl's whole command", "lower",
                      [r.cpu_s for r in runs["howl"]], name, seconds,
                      "howl's with members, predictions and files")


def push(howl, table, quick):
    """Ends that optimisers reach, and howl's members, as a share of howl's enclosure."""
    answer = howl_bounds(howl, ALL)
    outer, inner = bounds_of(answer), bounds_of(answer, kind="inner")
    runs = in_turns(1 if quick else 5, {"howl": lambda: howl_bounds(howl, ALL),
                                        "scipy SLSQP": slsqp, "CasADi/IPOPT": ipopt})
    share = lambda ends: np.array([(ends[key][1] - ends[key][0]) / (outer[key][1] - outer[key][0])
                                   for key in outer])
    for name in ("scipy SLSQP", "CasADi/IPOPT"):
        ends, failed, solves = runs[name][-1].value
        reached = share(ends)
        found = np.isfinite(reached)
        table.add(NAME, "R228: least share of the enclosure that members reach, over 24 parameters",
                  "higher", float(np.min(share(inner))), name,
                  float(np.min(np.where(found, reached, 0))),
                  f"no guarantee; {failed} of {solves} solves ended outside the family, "
                  f"{np.sum(~found)} of 24 ranges not found")
        table.add(NAME, "R228: CPU s for all bounds", "lower", [r.cpu_s for r in runs["howl"]],
                  name, [r.cpu_s for r in runs[name]], "howl's with the guaranteed enclosure")
