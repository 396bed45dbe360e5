"""Members of R228's family, drawn uniformly in omega_hz, xi, N and tau_s, against samplers.

The peers see the family as a density that is constant inside and zero outside: emcee (ensemble of
96 walkers) and PINTS (adaptive covariance, Haario and Bardenet), each in the natural parameters,
and, to their advantage, in howl's coordinates: xi and phase alone, of which the other parameters
follow by the closed form, with the Jacobian as density. Beside them stands what a user may write who
knows the closed form and sees that its density is nearly a product: rejection sampling in numpy, whose
draws are independent. It does not go beyond one mode, and is the reference for how howl's are spread.
"""
import csv
import os
import tempfile

import emcee
import numpy as np
import pints

import r228
from common import in_turns
from membership import (ALL, PARAMETERS, PHASE_TOL, SPREAD, XI_MAX, bounds_of, config, errors,
                        is_member, random_members)

NAME = "Members of the family"
FEW, MANY = 2000, 22000
WALKERS = 96


def natural_log_density(x):
    m = np.split(x, 4, axis=1)
    good = np.all(x > 0, axis=-1)
    out = np.full(len(x), -np.inf)
    inside = is_member(*[v[good] for v in m])
    out[np.flatnonzero(good)[inside]] = 0.0
    return out


def reduced_log_density(x):
    """xi and phase: gain and loop phase are free of them. Density: the Jacobian of N and omega."""
    xi, phase = x[:, :6], x[:, 6:]
    out = np.full(len(x), -np.inf)
    good = (np.all(xi > 0, axis=-1) & np.all(xi <= XI_MAX, axis=-1)
            & np.all(np.diff(xi, axis=-1) <= 0, axis=-1)
            & np.all(np.abs(phase - r228.PHASE) <= PHASE_TOL, axis=-1))
    xi, phase = xi[good], phase[good]
    t = np.tan(-phase)
    omega = r228.FREQUENCY_HZ * np.exp(-np.arcsinh(xi * t))
    inside = omega.max(axis=-1) <= (1 + SPREAD) * omega.min(axis=-1)
    log = np.sum(2 * np.log(omega * xi) - 3 * np.log(np.cos(phase))
                 - 0.5 * np.log(1 + (xi * t) ** 2), axis=-1)
    out[np.flatnonzero(good)[inside]] = log[inside]
    return out


def expanded(x, rng):
    """Natural parameters of points in (xi, phase): gain and loop phase are uniform."""
    if x.shape[1] == 24:
        return x
    gain = r228.GAIN * (1 + 0.01 * rng.uniform(-1, 1, (len(x), 6)))
    loop = np.radians(rng.uniform(-1, 1, (len(x), 6)))
    return np.hstack(r228.closed_form(x[:, :6], x[:, 6:], gain, loop))


def starting(reduced, count):
    members = random_members(count, np.random.default_rng(1))
    if not reduced:
        return members
    return np.hstack([members[:, 6:12], r228.PHASE + errors(*np.split(members, 4, axis=1))[1]])


def run_emcee(reduced, steps):
    """Samples, and how many of them are effective: by the longest autocorrelation time."""
    start = starting(reduced, WALKERS)
    density = reduced_log_density if reduced else natural_log_density
    sampler = emcee.EnsembleSampler(WALKERS, start.shape[1], density, vectorize=True)
    sampler.run_mcmc(start, steps)
    return effective(sampler.get_chain(discard=steps // 5))


def run_rejection(count):
    """Each xi with the density 3 xi^2 / XI_MAX^3, sorted; phases uniform; what is left of the density
    (log_rest, at most `largest`) and the window of omega decide."""
    rng = np.random.default_rng(5)
    steepest = np.max(np.abs(r228.PHASE[:, None] + [-PHASE_TOL, PHASE_TOL]), axis=1)
    largest = np.sum(2 * np.log(r228.FREQUENCY_HZ) - 3 * np.log(np.cos(steepest)))
    # What the window of omega leaves of the last xi, however the others are.
    first = r228.FREQUENCY_HZ[0] * np.exp(-np.arcsinh(XI_MAX * np.tan(steepest[0])))
    flattest = np.abs(r228.PHASE[5]) - PHASE_TOL
    most = np.sinh(np.log(r228.FREQUENCY_HZ[5] * (1 + SPREAD) / first)) / np.tan(flattest)
    kept, number = [], 0
    while number < count:
        xi = -np.sort(-XI_MAX * np.cbrt(rng.uniform(0, 1, (100000, 6))), axis=1)
        xi = xi[xi[:, 5] <= most]
        x = np.hstack([xi, r228.PHASE + PHASE_TOL * rng.uniform(-1, 1, xi.shape)])
        rest = reduced_log_density(x) - 2 * np.sum(np.log(xi), axis=1)
        if np.max(rest) > largest:
            raise RuntimeError("the rejection's bound does not hold")
        kept.append(x[np.log(rng.uniform(0, 1, len(x))) < rest - largest])
        number += len(kept[-1])
    samples = expanded(np.concatenate(kept), rng)
    if not np.all(is_member(*np.split(samples, 4, axis=1))):
        raise RuntimeError("a draw is no member")
    return {"samples": samples, "effective": number, "converged": True, "length": 1}


class Density(pints.LogPDF):
    def __init__(self, reduced):
        self.reduced = reduced

    def n_parameters(self):
        return 12 if self.reduced else 24

    def __call__(self, x):
        density = reduced_log_density if self.reduced else natural_log_density
        return density(np.asarray(x)[None])[0]


def run_pints(reduced, steps):
    start = starting(reduced, 60)
    sampler = pints.MCMCController(Density(reduced), 2, start[:2], sigma0=np.cov(start.T) / 100,
                                   method=pints.HaarioBardenetACMC)
    sampler.set_max_iterations(steps)
    sampler.set_log_to_screen(False)
    return effective(np.swapaxes(sampler.run(), 0, 1)[steps // 5:])


def effective(chain):
    steps, walkers, size = chain.shape
    length = float(np.max(emcee.autocorr.integrated_time(chain, quiet=True, tol=0)))
    return {"samples": chain.reshape(-1, size), "effective": steps * walkers / length,
            "converged": steps > 50 * length, "length": length}


def run_howl(howl, members):
    """Uniform draws: the effective number that howl states, and the members."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "config.yaml")
        with open(path, "w") as stream:
            stream.write(config(family=f"members: {members}, draw: uniform"))
        answer = howl.answer("family", path, "family.json")
        howl_rows = None
        if members == FEW:
            howl.run("family", path, folder)
            with open(os.path.join(folder, "family.csv")) as stream:
                howl_rows = list(csv.DictReader(stream))
    return answer, howl_rows


def compare(howl, table, quick):
    steps = {"emcee": 1000, "PINTS": 8000} if quick else {"emcee": 12000, "PINTS": 30000}
    runs = in_turns(1 if quick else 5, {
        "many": lambda: run_howl(howl, MANY), "one": lambda: run_howl(howl, 10),
        "emcee, natural parameters": lambda: run_emcee(False, steps["emcee"]),
        "emcee, howl's coordinates": lambda: run_emcee(True, steps["emcee"]),
        "PINTS, natural parameters": lambda: run_pints(False, steps["PINTS"]),
        "PINTS, howl's coordinates": lambda: run_pints(True, steps["PINTS"]),
        "rejection in closed form": lambda: run_rejection(2000 if quick else MANY)})
    many, one = runs.pop("many"), runs.pop("one")
    total = [m.value[0]["counts"]["effective_sample_size"] for m in many]
    ours = [n / (m.cpu_s - o.cpu_s) for n, m, o in zip(total, many, one)]
    whole = [n / m.cpu_s for n, m in zip(total, many)]
    for name, peer in runs.items():
        values = [p.value["effective"] / p.cpu_s for p in peer]
        last = peer[-1].value
        state = "" if last["converged"] else "; not converged, an upper limit"
        state = f"autocorrelation {last['length']:.0f} steps{state}"
        table.add(NAME, "effective uniform members a CPU s, program running", "higher", ours, name,
                  values, state)
        table.add(NAME, f"the same with howl's process, bounds and files for {MANY} members",
                  "higher", whole, name, values, state)
    extents(howl, table, runs, one)
    for name in ("rejection in closed form", "emcee, howl's coordinates"):
        agreement(howl, table, name, runs[name][-1].value)


def extents(howl, table, runs, one):
    """How much of the guaranteed ranges members reach: the mean share over 24 parameters."""
    answer = one[-1].value[0]
    outer, inner = bounds_of(answer), bounds_of(answer, kind="inner")
    width = np.array([outer[k, p][1] - outer[k, p][0] for p in PARAMETERS for k in ALL])
    ours = np.mean([(inner[k, p][1] - inner[k, p][0]) for p in PARAMETERS for k in ALL] / width)
    rng = np.random.default_rng(3)
    for name, peer in runs.items():
        shares = [np.mean(np.ptp(expanded(p.value["samples"], rng), axis=0) / width) for p in peer]
        table.add(NAME, "share of the guaranteed ranges that members reach, mean of 24", "higher",
                  float(ours), name, shares,
                  f"howl after {one[-1].cpu_s:.2g} CPU s, peer after {peer[-1].cpu_s:.3g}")


def agreement(howl, table, peer, other):
    """Both draw from the same distribution: the mean of xi in the first and last experiment."""
    _, rows = run_howl(howl, FEW)
    for column, name in ((0, "exp1"), (5, "exp6")):
        mine = np.array([float(r["xi"]) for r in rows if r["experiment"] == name])
        size = other["samples"].shape[1]
        theirs = other["samples"][:, column + (6 if size == 24 else 0)]
        error = np.hypot(np.std(mine) / np.sqrt(0.8 * len(mine)),
                         np.std(theirs) / np.sqrt(other["effective"]))
        table.note(NAME, f"mean xi of {name}: howl's {len(mine)} members {np.mean(mine):.5f}, "
                   f"{peer} {np.mean(theirs):.5f}, difference "
                   f"{(np.mean(mine) - np.mean(theirs)) / error:.1f} standard errors")
