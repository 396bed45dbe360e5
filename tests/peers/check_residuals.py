"""What bench/peers gives to other programs is howl's problem.

    check_residuals.py HOWL SOURCE_DIR

The residuals written there in numpy equal those of `howl fit` at its solution, one by one, with their
weights and the cost; every member that `howl family` lists passes the conditions written there, and
no longer does where a condition is broken. Exit status 77, after saying why, without numpy.
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

SKIP = 77
TOLERANCE = 1e-8  # standard deviations; relative for the cost


def run(howl, command, config, folder):
    subprocess.run([howl, command, config, "--out", folder, "--quiet"], check=True)


def check_fit(howl, source, modes, config):
    from joint_problem import Problem
    with tempfile.TemporaryDirectory() as folder:
        run(howl, "fit", os.path.join(source, config), folder)
        with open(os.path.join(folder, "solution.json")) as stream:
            solution = json.load(stream)
    problem = Problem(modes)
    logs = problem.logs_of(solution)
    values = dict(zip(problem.labels, problem.residuals(logs)))
    weights = dict(zip(problem.labels, problem.weights))
    mistakes = []
    if set(values) != {each["label"] for each in solution["residuals"]}:
        mistakes.append(f"{config}: the residuals are not the same ones")
    for each in solution["residuals"]:
        label, (value,) = each["label"], each["standard_deviations"]
        if abs(values.get(label, float("nan")) - value) <= TOLERANCE and \
                weights[label] == each["weight"]:
            continue
        mistakes.append(f"{config}: {label}: howl {value}, weight {each['weight']}; peers "
                        f"{values.get(label)}, weight {weights.get(label)}")
    cost = problem.cost(logs)
    if not abs(cost - solution["cost"]) <= TOLERANCE * solution["cost"]:
        mistakes.append(f"{config}: cost: howl {solution['cost']}, peers {cost}")
    # A residual that does not move would agree as well: every unknown moves the cost.
    for k in range(problem.size):
        logs[k] += 0.01
        if not abs(problem.cost(logs) - cost) > 1e-6:
            mistakes.append(f"{config}: unknown {k} does not move the cost")
        logs[k] -= 0.01
    return mistakes


def check_members(howl, source):
    import numpy as np

    import r228
    from membership import PARAMETERS, margins
    with tempfile.TemporaryDirectory() as folder:
        run(howl, "family", os.path.join(source, "configs/r228.yaml"), folder)
        with open(os.path.join(folder, "family.csv")) as stream:
            rows = list(csv.DictReader(stream))
    order = {name: k for k, name in enumerate(r228.NAMES)}
    members = np.full((4, 1 + max(int(row["member"]) for row in rows), 6), np.nan)
    for row in rows:
        for j, name in enumerate(PARAMETERS):
            members[j, int(row["member"]), order[row["experiment"]]] = float(row[name])
    members = members[:, ~np.isnan(members).any(axis=(0, 2))]
    mistakes = []
    if members.shape[1] < 1000:
        mistakes.append(f"family.csv: {members.shape[1]} members, expected 1000")
    worst = np.min(margins(*members))
    if not worst >= -1e-9:
        mistakes.append(f"family.csv: a member breaks a condition by {-worst} of its tolerance")
    # Beyond a condition: N and tau by more than twice their tolerances, omega of one experiment out of
    # the window that all are in.
    for j, factor in ((2, 1.025), (3, 1.02), (0, [1.3, 1, 1, 1, 1, 1])):
        moved = members.copy()
        moved[j] *= factor
        if np.any(np.all(margins(*moved) >= 0, axis=-1)):
            mistakes.append(f"{PARAMETERS[j]} times {factor} is still a member")
    return mistakes


def main():
    howl, source = sys.argv[1:3]
    try:
        import numpy  # noqa: F401
    except ImportError:
        print(f"skipped: {sys.executable} has no numpy (python3-numpy)")
        return SKIP
    sys.dont_write_bytecode = True
    sys.path.insert(0, os.path.join(source, "bench", "peers"))
    mistakes = check_fit(howl, source, 1, "configs/r228.yaml")
    mistakes += check_fit(howl, source, 2, "configs/r228_two_modes.yaml")
    mistakes += check_members(howl, source)
    print("\n".join(mistakes) if mistakes else "the peers' problems are howl's")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
