"""The limit cycle itself: frequency and amplitude of p's first harmonic, by howl's harmonic balance
(the frequency that `howl simulate` begins with, the amplitude that `howl family` predicts), by howl's
simulation, and by two collocation methods.

Peers: collocation of the delay equation on a periodic mesh with Gauss points, as DDE-BIFTOOL does
(Engelborghs and others 2002), written here in numpy; and scipy's solve_bvp on ordinary equations in
which the delay is a line of Chebyshev nodes. The reference is loop.fourier_cycle, to rounding.
"""

import numpy as np
from numpy.polynomial import chebyshev, legendre
from scipy.integrate import solve_bvp
from scipy.optimize import root

from common import in_turns
from loop import LOOPS, describing_function, fourier_cycle
from simulation import Past, Rates, SAMPLING_HZ, DURATION_S, howl_record, line_of

NAME = "Limit cycles"


def first_harmonic(x, p_of):
    """Amplitude of the first harmonic of p, given over one period on [0, 1)."""
    t = (np.arange(1024) + 0.5) / 1024
    return float(2 * abs(np.mean(p_of(t) * np.exp(-2j * np.pi * t))))


class Collocation:
    """x'(t) = A x + b Phi(c x'(t - tau)) on `intervals` of one period, each a polynomial."""

    def __init__(self, loop, intervals, degree=4):
        self.loop, self.rates = loop, Rates(loop)
        self.intervals, self.degree, self.size = intervals, degree, len(self.rates.b)
        local = np.arange(degree + 1) / degree  # representation points
        self.inverse = np.linalg.inv(np.vander(local, increasing=True))
        gauss = (legendre.leggauss(degree)[0] + 1) / 2
        self.points = ((np.arange(intervals)[:, None] + gauss) / intervals).ravel()

    def evaluate(self, nodes, t, order):
        """The profile or its derivative by t at times on the circle [0, 1)."""
        place = np.floor((t % 1.0) * self.intervals).astype(int) % self.intervals
        u = (t % 1.0) * self.intervals - place
        powers = np.vander(u, self.degree + 1, increasing=True)
        if order:
            powers = np.hstack([np.zeros((len(u), 1)),
                                powers[:, :-1] * np.arange(1, self.degree + 1)]) * self.intervals
        basis = powers @ self.inverse
        index = (place[:, None] * self.degree + np.arange(self.degree + 1)) % len(nodes)
        return np.einsum("tk,tki->ti", basis, nodes[index])

    def solve(self):
        f, _ = describing_function(self.loop)
        t = np.arange(self.intervals * self.degree) / (self.intervals * self.degree)
        start = Past(self.loop, harmonics=2)(t / f)  # the first harmonic alone
        scale = np.max(np.abs(start), axis=0)
        anchor = start / scale
        pick = np.zeros(self.size)
        pick[0::2] = 1.0

        def residual(x):
            nodes, hz = x[:-1].reshape(-1, self.size) * scale, x[-1] * f
            rate = self.evaluate(nodes, self.points, 1) * hz
            delayed = self.evaluate(nodes, self.points - self.loop.tau_s * hz, 1) * hz
            q = self.loop.flame(delayed @ pick)
            right = self.evaluate(nodes, self.points, 0) @ self.rates.a.T + np.outer(q, self.rates.b)
            phase = np.sum((nodes / scale - anchor) * np.roll(anchor, len(t) // 4, axis=0))
            return np.append((rate - right) / (scale * f), phase / len(t))

        x = root(residual, np.append(anchor.ravel(), 1.0), tol=1e-12).x
        nodes = x[:-1].reshape(-1, self.size) * scale
        return x[-1] * f, first_harmonic(x, lambda t: self.evaluate(nodes, t, 0)[:, 0::2].sum(axis=1))


def boundary_value(loop, nodes=16, tol=1e-6):
    """solve_bvp: states x, and p' along the delay at Chebyshev nodes, the first being its inlet."""
    rates, f0 = Rates(loop), describing_function(loop)[0]
    y = np.cos(np.pi * np.arange(nodes) / (nodes - 1))  # 1: now, -1: tau ago
    vander = chebyshev.chebvander(y, nodes - 1)
    slope = np.stack([chebyshev.chebval(y, chebyshev.chebder(np.eye(nodes)[k]))
                      for k in range(nodes)], axis=1) @ np.linalg.inv(vander)
    size = len(rates.b)
    t = np.linspace(0, 1, 41)
    before = Past(loop, harmonics=2)
    ages = (1 - y[1:]) / 2 * loop.tau_s
    guess = np.vstack([before(t / f0).T] + [
        before(t / f0 - age, 1)[:, 0::2].sum(axis=1)[None] for age in ages])
    scale = np.max(np.abs(guess), axis=1, keepdims=True)

    def rate(_, u, p):
        u = u * scale
        x, line = u[:size], u[size:]
        dx = rates.a @ x + rates.b[:, None] * loop.flame(line[-1])
        whole = np.vstack([dx[0::2].sum(axis=0), line])
        return np.vstack([dx, (slope @ whole)[1:] * 2 / loop.tau_s]) / scale / (p[0] * f0)

    def ends(a, b, p):
        # One more: p' along the delay is zero at its outlet, which fixes the phase.
        return np.append(a - b, a[-1])

    done = solve_bvp(rate, ends, t, guess / scale, p=[1.0], tol=tol, max_nodes=20000)
    p_of = lambda t: (done.sol(t)[:size] * scale[:size])[0::2].sum(axis=0)
    return done.p[0] * f0, first_harmonic(done, p_of)


def howl_balance(howl, loop):
    """Frequency and amplitude by howl's harmonic balance, from two commands."""
    frequency = howl.answer("simulate", loop.config(
        "{duration_s: 0.5, settle_s: 0, combustion_noise_relative: 0, sensor_noise_relative: 0}"),
        "simulation.json")["experiments"][0]["cycle_hz"]
    if loop.m:  # with two modes the family's search finds no member where xi is held
        return frequency, np.nan
    text = loop.config("{flame_shape: tanh, saturation: 1}") + "family: {members: 1}\n"
    predictions = howl.answer("family", text, "family.json")["predictions"]
    return frequency, next(np.mean(p["interval"]) for p in predictions
                           if p["name"] == "p_amplitude")


def howl_simulated(howl, loop):
    p = howl_record(howl, loop, DURATION_S)
    return line_of(p, SAMPLING_HZ, describing_function(loop)[0])


def compare(howl, table, quick):
    for title, loop in LOOPS.items():
        reference = fourier_cycle(loop)[:2]
        methods = {"howl": lambda: howl_balance(howl, loop),
                   "howl simulate": lambda: howl_simulated(howl, loop),
                   "collocation, 20 intervals": Collocation(loop, 20).solve,
                   "collocation, 60 intervals": Collocation(loop, 60).solve,
                   "solve_bvp on a Chebyshev delay": lambda: boundary_value(loop),
                   "describing function alone": lambda: describing_function(loop)}
        runs = in_turns(1 if quick else 5, methods)
        errors = {name: [abs(v / r - 1) for v, r in zip(run[-1].value, reference)]
                  for name, run in runs.items()}
        for name in list(methods)[1:]:
            for which, quantity in enumerate(("frequency", "amplitude")):
                if np.isnan(errors["howl"][which]):
                    table.add(NAME, f"{title}: relative error of the {quantity}", "lower", None, name,
                              errors[name][which], "howl's commands give none here")
                    continue
                table.add(NAME, f"{title}: relative error of the {quantity}", "lower",
                          errors["howl"][which], name, errors[name][which])
            table.add(NAME, f"{title}: CPU s", "lower", [r.cpu_s for r in runs["howl"]], name,
                      [r.cpu_s for r in runs[name]], "howl: two commands, processes and all")
