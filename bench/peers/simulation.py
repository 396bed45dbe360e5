"""Simulation of the delay loop in its cycle, without noise: howl simulate against JiTCDDE (compiled,
neutral) and the method of steps on scipy's solve_ivp (DOP853). All begin on the cycle.

Accuracy: frequency and amplitude of the fundamental against the cycle with all its harmonics
(loop.fourier_cycle), fitted to two seconds of the record in the same way for all. Peers run at several
tolerances. Times are theirs at the largest tolerance at which the frequency is right to 1e-6 and the
amplitude to 1e-4; howl has no tolerance to choose.
"""
import os
import pathlib
import tempfile
import warnings

import jitcdde
import numpy as np
import symengine
from scipy.integrate import solve_ivp

from common import in_turns
from loop import LOOPS, fourier_cycle, line_of

NAME = "Simulation"
SAMPLING_HZ, SETTLE_S, DURATION_S = 5000, 1.0, 2.0
LONG_S = 60.0  # of howl's long record, for its time without that of a process
TOLERANCES = [1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10]
GOOD_ENOUGH = (1e-6, 1e-4)  # of frequency and amplitude: less than any record tells
NODES = 40     # Chebyshev nodes to each delay, three quarters of a period: to rounding


class Past:
    """The states on the cycle, and their rates, at any time before zero: no jump at zero."""

    def __init__(self, loop, harmonics=40):
        f, _, p = fourier_cycle(loop)
        self.s = 2j * np.pi * f * np.arange(1, harmonics)
        q = p[1:harmonics] / loop.response(self.s)
        rows = []
        for c, w in loop.modes():
            mode = q * c * self.s / (self.s**2 + 2 * w * loop.xi * self.s + w * w)
            rows += [mode, mode / self.s]
        self.states = np.array(rows).T

    def __call__(self, t, order=0):
        return np.real(np.exp(np.outer(np.atleast_1d(t), self.s)) @ (
            self.states * (self.s**order)[:, None]))


class Rates:
    """The state's rate for a given q, as a matrix and a vector."""

    def __init__(self, loop):
        size = 2 * len(loop.modes())
        self.a, self.b = np.zeros((size, size)), np.zeros(size)
        for i, (c, w) in enumerate(loop.modes()):
            self.a[2 * i, 2 * i:2 * i + 2] = -2 * loop.xi * w, -w * w
            self.a[2 * i + 1, 2 * i] = 1.0
            self.b[2 * i] = c


def method_of_steps(loop, rtol):
    """On each interval of one delay q is known; it is kept as a polynomial through Chebyshev nodes."""
    rates, tau = Rates(loop), loop.tau_s
    nodes = -np.cos(np.pi * np.arange(NODES) / (NODES - 1))
    weights = (-1.0) ** np.arange(NODES)
    weights[[0, -1]] /= 2
    total = SETTLE_S + DURATION_S
    samples = np.arange(round(total * SAMPLING_HZ)) / SAMPLING_HZ
    p = np.zeros(len(samples))
    rate_of = lambda x, q: rates.a @ x + rates.b * q

    def heat(values):
        def at(u):
            gap = u - nodes
            exact = np.abs(gap) < 1e-14
            if np.any(exact):
                return values[np.argmax(exact)]
            share = weights / gap
            return share @ values / np.sum(share)
        return at

    local = (nodes + 1) / 2 * tau
    before = Past(loop)
    v, state, start = before(local - tau, 1)[:, 0::2].sum(axis=1), before(0.0)[0], 0.0
    while start < total:
        values = loop.flame(v)
        q = heat(values)
        done = solve_ivp(lambda t, x: rate_of(x, q(2 * t / tau - 1)), (0, tau), state,
                         method="DOP853", rtol=rtol, atol=rtol * 1e-3, dense_output=True)
        inside = (samples >= start) & (samples < start + tau)
        if np.any(inside):
            p[inside] = done.sol(samples[inside] - start)[0::2].sum(axis=0)
        at_nodes = done.sol(local)
        v = (rates.a @ at_nodes + np.outer(rates.b, values))[0::2].sum(axis=0)
        state, start = done.y[:, -1], start + tau
    return p[samples >= SETTLE_S]


class Compiled:
    """JiTCDDE: compiled once, which is not counted."""

    def __init__(self, loop):
        self.loop = loop
        rates = Rates(loop)
        size = len(rates.b)
        rate = sum(jitcdde.dy(i, jitcdde.t - loop.tau_s) for i in range(0, size, 2))
        q = symengine.Symbol("q")
        f = [sum(rates.a[i, j] * jitcdde.y(j) for j in range(size) if rates.a[i, j])
             + rates.b[i] * q for i in range(size)]
        self.dde = jitcdde.jitcdde(f, helpers=[(q, symengine.tanh(loop.slope * rate))],
                                   max_delay=loop.tau_s, verbose=False)
        self.dde.compile_C(simplify=False)

    def run(self, rtol):
        dde, loop = self.dde, self.loop
        dde.purge_past()
        before = Past(loop)
        for t in np.linspace(-2 * loop.tau_s, 0, 400):
            dde.add_past_point(t, before(t)[0], before(t, 1)[0])
        dde.set_integration_parameters(rtol=rtol, atol=rtol * 1e-3, first_step=1e-5,
                                       max_step=loop.tau_s)
        dde.initial_discontinuities_handled = True
        times = SETTLE_S + np.arange(round(DURATION_S * SAMPLING_HZ)) / SAMPLING_HZ
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return np.array([dde.integrate(t)[0::2].sum() for t in times])


def howl_record(howl, loop, seconds):
    simulate = (f"{{duration_s: {seconds}, sampling_hz: {SAMPLING_HZ}, settle_s: {SETTLE_S}, "
                "combustion_noise_relative: 0, sensor_noise_relative: 0}")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "config.yaml"
        path.write_text(loop.config(simulate))
        howl.run("simulate", str(path), folder)
        if seconds > DURATION_S:
            return None
        return np.loadtxt(os.path.join(folder, "exp1.csv"), delimiter=",", skiprows=1)[:, 0]


def errors(p, reference):
    f, amplitude = line_of(p, SAMPLING_HZ, reference[0])
    return abs(f / reference[0] - 1), abs(amplitude / reference[1] - 1)


def compare(howl, table, quick):
    for title, loop in LOOPS.items():
        reference = fourier_cycle(loop)
        compiled = Compiled(loop)
        solvers = {"JiTCDDE": compiled.run, "solve_ivp, method of steps":
                   lambda rtol: method_of_steps(loop, rtol)}
        ours = errors(howl_record(howl, loop, DURATION_S), reference)
        tried = {name: try_all(solve, reference, quick) for name, solve in solvers.items()}
        chosen = {name: cheapest(results) for name, results in tried.items()}
        runs = in_turns(1 if quick else 5, {
            "short": lambda: howl_record(howl, loop, DURATION_S),
            "long": lambda: howl_record(howl, loop, LONG_S),
            **{name: lambda name=name: solvers[name](chosen[name]) for name in solvers}})
        alone = [(b.cpu_s - a.cpu_s) / (LONG_S - DURATION_S)
                 for a, b in zip(runs["short"], runs["long"])]
        for name in solvers:
            best = min(tried[name], key=lambda rtol: tried[name][rtol][0])
            for which, quantity in enumerate(("frequency", "amplitude")):
                table.add(NAME, f"{title}: least relative error of the {quantity}", "lower",
                          ours[which], name, tried[name][best][which], f"peer at rtol {best:.0e}")
            seconds = [r.cpu_s for r in runs[name]]
            note = f"peer at rtol {chosen[name]:.0e}: errors " + ", ".join(
                f"{e:.1e}" for e in tried[name][chosen[name]])
            table.add(NAME, f"{title}: CPU s to simulate a second at {SAMPLING_HZ} Hz", "lower",
                      alone, name, [s / (SETTLE_S + DURATION_S) for s in seconds],
                      f"{note}; howl's with the record as text")
            table.add(NAME, f"{title}: CPU s for {SETTLE_S + DURATION_S:g} s, howl as a process",
                      "lower", [a.cpu_s for a in runs["short"]], name, seconds,
                      "peer: without imports and compiling")


def try_all(solve, reference, quick):
    """{tolerance: errors of frequency and amplitude}, of those at which the solver comes through."""
    found = {}
    for rtol in TOLERANCES[:2] if quick else TOLERANCES:
        try:
            found[rtol] = errors(solve(rtol), reference)
        except jitcdde.UnsuccessfulIntegration:
            print(f"    rtol {rtol}: UnsuccessfulIntegration", flush=True)
            continue
        print(f"    rtol {rtol}: errors {found[rtol]}", flush=True)
    return found


def cheapest(found):
    """The largest tolerance that is good enough, else that of the least error."""
    enough = [rtol for rtol, error in found.items()
              if all(e <= limit for e, limit in zip(error, GOOD_ENOUGH))]
    return max(enough) if enough else min(found, key=lambda rtol: found[rtol][0])
