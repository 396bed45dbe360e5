"""The joint fit against general solvers on the same residuals and the same starts.

Peers: scipy.optimize.least_squares (MINPACK's Levenberg-Marquardt and the reflective trust region,
with the exact Jacobian that CasADi derives; and the latter as it comes, with differences), and
IPOPT through CasADi with the exact Hessian. All at their default tolerances.
"""
import os
import subprocess
import sys

import casadi
import numpy as np
from scipy.optimize import least_squares

import r228
from common import SOURCE, timed
from joint_problem import Problem

NAME = "Joint fit"
CONFIGS = {1: "configs/r228.yaml", 2: "configs/r228_two_modes.yaml"}
SAME_COST = 1e-6  # relative, as howl counts the starts that reach its best
MANY = 400        # howl's own starts, for its time without that of a process


class CasadiLib:
    log, exp, sqrt, cos, sin = casadi.log, casadi.exp, casadi.sqrt, casadi.cos, casadi.sin
    atan2, fmax = staticmethod(casadi.atan2), staticmethod(casadi.fmax)
    stack = staticmethod(lambda rows: casadi.vertcat(*rows))


class Solvers:
    """Each takes a start and returns the cost that it reached."""

    def __init__(self, modes):
        self.problem = Problem(modes)
        self.bounds = self.problem.bounds()
        x = casadi.SX.sym("x", self.problem.size)
        residuals = self.problem.weighted(x, CasadiLib)
        derive = casadi.Function("J", [x], [casadi.jacobian(residuals, x)])
        self.jacobian = lambda logs: np.asarray(derive(logs).full())
        self.ipopt_solver = casadi.nlpsol(
            "solver", "ipopt", {"x": x, "f": 0.5 * casadi.sumsqr(residuals)},
            {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes"})

    def lm(self, start):
        return least_squares(self.problem.weighted, start, self.jacobian, method="lm").cost

    def trf(self, start):
        return least_squares(self.problem.weighted, start, self.jacobian, self.bounds).cost

    def trf_plain(self, start):
        return least_squares(self.problem.weighted, start, bounds=self.bounds).cost

    def ipopt(self, start):
        return float(self.ipopt_solver(x0=start, lbx=self.bounds[0], ubx=self.bounds[1])["f"])

    def all(self):
        return {"scipy lm, exact Jacobian": self.lm, "scipy trf, exact Jacobian": self.trf,
                "scipy trf": self.trf_plain, "CasADi/IPOPT": self.ipopt}


def config_at(modes, problem, start):
    """The config with one start, at these values."""
    floors = {"omega_hz": ", min: 150", "xi": ", min: 0.02"} if modes == 2 else {}
    lines = []
    for kind in problem.kinds:
        values = np.exp(start[problem.parts[kind]])
        if kind == "M":
            lines.append("  M: {scope: shared, max: 5000, initial: %r}" % float(values[0]))
            continue
        if kind in floors:
            lines.append("  %s: {%s}" % (kind, floors[kind].removeprefix(", ")))
        lines += ["  %s.%s: {initial: %r%s}" % (name, kind, float(v), floors.get(kind, ""))
                  for name, v in zip(r228.NAMES, values)]
    text = (SOURCE / CONFIGS[modes]).read_text()
    before, _, after = text.partition("parameters:\n")
    if after:  # the section ends where the next one begins
        after = after[after.index("residuals:"):]
    return "\n".join([before.rstrip(), "solver: {starts: 1}", "parameters:", *lines, after])


def howl_cost(howl, modes, problem, start):
    solution = howl.answer("fit", config_at(modes, problem, start), "solution.json", allowed=(0, 1))
    return solution["cost"] if solution["cost"] is not None else np.inf


def howl_seconds_per_start(howl, modes):
    """From many starts less one, so that what is done once a process does not count."""
    text = (SOURCE / CONFIGS[modes]).read_text()
    cpu = {starts: timed(lambda: howl.answer("fit", f"{text}\nsolver: {{starts: {starts}}}\n",
                                             "solution.json")).cpu_s for starts in (1, MANY + 1)}
    return (cpu[MANY + 1] - cpu[1]) / MANY


def check_residuals(howl, table, modes):
    solution = howl.answer("fit", str(SOURCE / CONFIGS[modes]), "solution.json")
    problem = Problem(modes)
    logs = problem.logs_of(solution)
    mine = dict(zip(problem.labels, problem.residuals(logs)))
    worst = max(abs(mine[r["label"]] - r["standard_deviations"][0]) for r in solution["residuals"])
    cost = problem.cost(logs)
    if len(mine) != len(solution["residuals"]) or worst > 1e-8 or \
            abs(cost - solution["cost"]) > 1e-8 * cost:
        raise RuntimeError(f"residuals differ from howl's: {worst}, cost {cost}")
    table.note(NAME, f"{title(modes)}: at howl's solution the {len(mine)} residuals written for the "
               f"peers equal howl's within {worst:.1e} standard deviations (cost {cost:.9g})")


def title(modes):
    return "R228, one mode" if modes == 1 else "R228, two modes with the line at 750 Hz"


def compare(howl, table, quick):
    for modes in (1, 2):
        check_residuals(howl, table, modes)
        speed(howl, table, modes, 8 if quick else 50, 2 if quick else 10)
        reach(howl, table, modes, 8 if quick else 60)


def speed(howl, table, modes, num_starts, rounds):
    """From the starts that howl itself would draw, in turns."""
    problem, solvers = Problem(modes), Solvers(modes).all()
    rng = np.random.default_rng(modes)
    starts = [problem.start(rng) for _ in range(num_starts)]
    calls = {"howl": lambda start: howl_cost(howl, modes, problem, start), **solvers}
    seconds = {name: [] for name in calls}
    costs = {name: [] for name in calls}
    alone = []
    for batch in np.array_split(np.arange(num_starts), rounds):
        for name, solve in calls.items():
            runs = [timed(lambda: solve(starts[k])) for k in batch]
            costs[name] += [run.value for run in runs]
            seconds[name].append(np.mean([run.cpu_s for run in runs]))
        alone.append(howl_seconds_per_start(howl, modes))
    cold = {name: cold_seconds(name, modes, 2 if rounds < 5 else 5) for name in solvers}
    add_reach(table, f"{title(modes)}: of {num_starts} starts drawn as howl draws them", costs)
    for name in solvers:
        table.add(NAME, f"{title(modes)}: CPU s a start, program running", "lower", alone, name,
                  seconds[name])
        table.add(NAME, f"{title(modes)}: CPU s of a process with one start", "lower",
                  seconds["howl"], name, cold[name], "howl's does more than solve")


def reach(howl, table, modes, num_starts):
    """From starts three times as far, in the logarithm, as howl draws them."""
    problem, solvers = Problem(modes), Solvers(modes).all()
    rng = np.random.default_rng(100 + modes)
    starts = [problem.start(rng, 3) for _ in range(num_starts)]
    with np.errstate(over="ignore"):  # far out a step may leave the numbers, and is taken back
        costs = {name: [solve(start) for start in starts] for name, solve in solvers.items()}
    costs["howl"] = [howl_cost(howl, modes, problem, start) for start in starts]
    add_reach(table, f"{title(modes)}: of {num_starts} starts thrice as far", costs)


def add_reach(table, what, costs):
    best = min(min(c) for c in costs.values())
    share = {name: np.mean(np.array(c) <= best * (1 + SAME_COST)) for name, c in costs.items()}
    for name in costs:
        if name == "howl":
            continue
        table.add(NAME, f"{what}, share at the best cost", "higher", share["howl"], name,
                  share[name], f"lowest cost {best:.7g}; howl's {min(costs['howl']):.7g}, peer's "
                  f"{min(costs[name]):.7g}")


def cold_seconds(name, modes, repeats):
    """A process of its own that imports, builds the problem and solves it once."""
    words = [sys.executable, os.path.abspath(__file__), name, str(modes)]
    return [timed(lambda: subprocess.run(words, check=True, stdout=subprocess.DEVNULL)).cpu_s
            for _ in range(min(repeats, 5))]


if __name__ == "__main__":
    chosen = int(sys.argv[2])
    print(Solvers(chosen).all()[sys.argv[1]](Problem(chosen).start(np.random.default_rng(1))))
