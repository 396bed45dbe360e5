"""The farthest that optimisers push each parameter of the family: inner bounds, no guarantee."""
import casadi
import numpy as np
from scipy.optimize import minimize

import r228
from membership import (GAIN_TOL, LOOP_GAIN_MIN, LOOP_TOL, PARAMETERS, PHASE_TOL, SPREAD, XI_MAX,
                        margins, random_members)


def slsqp(starts=3):
    """Inner ends from some members each; what it ends at must be a member to 1e-6."""
    members = random_members(60, np.random.default_rng(1))
    scale = members.mean(axis=0)
    split = lambda x: np.split(x * scale, 4)
    condition = {"type": "ineq", "fun": lambda x: margins(*split(x))}

    def solve(k, sign, start):
        return minimize(lambda x: -sign * x[k], start / scale, method="SLSQP",
                        constraints=[condition], options={"maxiter": 100}).x

    return inner_ends(solve, members, scale, starts)


def ipopt(starts=3):
    members = random_members(60, np.random.default_rng(1))
    scale = members.mean(axis=0)
    x, which_way = casadi.SX.sym("x", 24), casadi.SX.sym("c", 24)
    omega, xi, n, tau = (x[6 * j:6 * j + 6] * scale[6 * j:6 * j + 6] for j in range(4))
    detuning = (omega / r228.FREQUENCY_HZ - r228.FREQUENCY_HZ / omega) / (2 * xi)
    phase = casadi.atan(detuning)
    size = n / (4 * np.pi * omega * xi * casadi.sqrt(1 + detuning**2))
    gain = size / r228.GAIN - 1
    loop = 1.5 * np.pi + phase - r228.W * tau
    rows = [gain / GAIN_TOL, (phase - r228.PHASE) / PHASE_TOL, loop / LOOP_TOL]
    ratios = [omega[i] / omega[j] for i in range(6) for j in range(6) if i != j]
    slope = (r228.W * abs(r228.FLAME_SLOPE))[:4]
    g = casadi.vertcat(*rows, (xi[:5] - xi[1:]) / XI_MAX, *ratios, slope * size[:4])
    low = np.concatenate([-np.ones(18), np.zeros(5), np.zeros(30), np.full(4, LOOP_GAIN_MIN)])
    high = np.concatenate([np.ones(18), np.full(5, np.inf), np.full(30, 1 + SPREAD),
                           np.full(4, np.inf)])
    solver = casadi.nlpsol("s", "ipopt", {"x": x, "p": which_way, "f": casadi.dot(which_way, x),
                                          "g": g},
                           {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes",
                            "ipopt.max_iter": 300})
    least, most = np.full(24, 1e-9), np.full(24, np.inf)
    most[6:12] = XI_MAX / scale[6:12]

    def solve(k, sign, start):
        return solver(x0=start / scale, p=-sign * np.eye(24)[k], lbx=least, ubx=most, lbg=low,
                      ubg=high)["x"].full().ravel()

    return inner_ends(solve, members, scale, starts)


def inner_ends(solve, members, scale, starts):
    rng = np.random.default_rng(2)
    ends, failed = {}, 0
    for k in range(24):
        best = {-1: np.inf, 1: -np.inf}
        for sign in best:
            for start in members[rng.choice(len(members), starts, replace=False)]:
                x = solve(k, sign, start)
                if np.all(np.isfinite(x)) and np.min(margins(*np.split(x * scale, 4))) > -1e-6:
                    best[sign] = (min if sign < 0 else max)(best[sign], x[k] * scale[k])
                else:
                    failed += 1
        ends[k % 6, PARAMETERS[k // 6]] = (best[-1], best[1])
    return ends, failed, 48 * starts
