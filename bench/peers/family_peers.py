#!/usr/bin/python3
"""The unfalsified family of test R228 by general tools, against howl, in one run.

  1. Bounds of every parameter by plain repeated optimisation (scipy, SLSQP, both directions,
     several starts each).
  2. Uniform members by an ensemble sampler (emcee), in the natural parameters and, to its
     advantage, in howl's own coordinates with the Jacobian.

Usage: family_peers.py BUILD_DIR     (needs python3-scipy and python3-emcee)
"""
import json
import subprocess
import sys
import time

import emcee
import numpy as np
from scipy.optimize import minimize

F = np.array([219.9, 209.1, 205.7, 202.7, 198.4, 179.8])
PHASE = np.radians([-5.74, -9.44, -14.35, -19.18, -22.92, -42.72])
GAIN = np.array([12.14, 13.15, 14.79, 16.05, 18.80, 45.01])
SLOPE = np.array([0.703e-4, 0.707e-4, 0.670e-4, 0.626e-4, np.nan, np.nan])
W = 2 * np.pi * F
GAIN_TOL, PHASE_TOL, LOOP_TOL = 0.01, np.radians(0.5), np.radians(1.0)
SPREAD, XI_MAX = 0.25, 0.3


def errors(omega, xi, n, tau):
    """Gain error, phase error, loop phase error of (5c) and (1a); last axis: experiment."""
    o = 2 * np.pi * omega
    z = n / (2 * o * xi + 1j * (W - o * o / W))
    phase = np.angle(z)
    return (np.abs(z) / GAIN - 1, phase - PHASE, 1.5 * np.pi + phase - W * tau)


def margins(omega, xi, n, tau):
    """Every condition as something that must not be negative, each in units of its tolerance."""
    g, p, loop = errors(omega, xi, n, tau)
    window = 1 + SPREAD - np.max(omega, axis=-1) / np.min(omega, axis=-1)
    chain = (xi[..., :-1] - xi[..., 1:]) / XI_MAX  # phi falls along the table
    return np.concatenate([1 - g / GAIN_TOL, 1 + g / GAIN_TOL, 1 - p / PHASE_TOL,
                           1 + p / PHASE_TOL, 1 - loop / LOOP_TOL, 1 + loop / LOOP_TOL,
                           1 - xi / XI_MAX, xi / XI_MAX, chain, window[..., None] / SPREAD], axis=-1)


def closed_form(xi, phase, gain, loop):
    t = np.tan(-phase)
    omega = F * np.exp(-np.arcsinh(xi * t))
    return (omega, xi, gain * 2 * xi * 2 * np.pi * omega / np.cos(phase),
            (1.5 * np.pi + phase - loop) / W)


def random_members(count, rng):
    found = []
    while len(found) < count:
        xi = np.sort(rng.uniform(0.01, XI_MAX, 6) * rng.uniform())[::-1]
        m = closed_form(xi, PHASE + PHASE_TOL * rng.uniform(-0.9, 0.9, 6),
                        GAIN * (1 + GAIN_TOL * rng.uniform(-0.9, 0.9, 6)),
                        LOOP_TOL * rng.uniform(-0.9, 0.9, 6))
        if np.all(margins(*m) >= 0):
            found.append(np.concatenate(m))
    return np.array(found)


def optimise_bounds(rng, starts=3):
    members = random_members(200, rng)
    scale = np.tile(members.mean(axis=0), 1)
    split = lambda x: [(x * scale)[k:k + 6] for k in (0, 6, 12, 18)]
    bounds = {}
    failures = solves = 0
    begin = time.perf_counter()
    constraint = {"type": "ineq", "fun": lambda x: margins(*split(x))}
    for k in range(24):
        for sign in (-1, 1):
            best = None
            for start in members[rng.choice(len(members), starts, replace=False)]:
                solves += 1
                r = minimize(lambda x: -sign * x[k], start / scale, method="SLSQP",
                             constraints=[constraint], options={"maxiter": 100})
                if r.success and np.min(margins(*split(r.x))) > -1e-6:
                    value = r.x[k] * scale[k]
                    best = value if best is None else (max if sign > 0 else min)(best, value)
                else:
                    failures += 1
            bounds[k, sign] = best
    return bounds, time.perf_counter() - begin, solves, failures


def natural_log_density(x):
    m = [x[:, k:k + 6] for k in (0, 6, 12, 18)]
    good = np.all(m[0] > 0, axis=-1) & np.all(m[1] > 0, axis=-1) & np.all(m[2] > 0, axis=-1)
    out = np.full(len(x), -np.inf)
    if np.any(good):
        inside = np.all(margins(*[v[good] for v in m]) >= 0, axis=-1)
        out[np.flatnonzero(good)[inside]] = 0.0
    return out


def reduced_log_density(x):
    """xi and phase alone: gain and loop phase are free of them. Density: N's and omega's Jacobian."""
    xi, phase = x[:, :6], x[:, 6:]
    out = np.full(len(x), -np.inf)
    good = (np.all(xi > 0, axis=-1) & np.all(xi <= XI_MAX, axis=-1)
            & np.all(np.diff(xi, axis=-1) <= 0, axis=-1)
            & np.all(np.abs(phase - PHASE) <= PHASE_TOL, axis=-1))
    xi, phase = xi[good], phase[good]
    t = np.tan(-phase)
    omega = F * np.exp(-np.arcsinh(xi * t))
    inside = omega.max(axis=-1) <= (1 + SPREAD) * omega.min(axis=-1)
    log = np.sum(np.log(omega * xi / np.cos(phase))
                 + np.log(omega * xi / np.cos(phase) ** 2 / np.sqrt(1 + (xi * t) ** 2)), axis=-1)
    out[np.flatnonzero(good)[inside]] = log[inside]
    return out


def ensemble(start, log_density, steps):
    sampler = emcee.EnsembleSampler(start.shape[0], start.shape[1], log_density, vectorize=True)
    begin = time.perf_counter()
    sampler.run_mcmc(start, steps, progress=False)
    seconds = time.perf_counter() - begin
    time_steps = np.max(sampler.get_autocorr_time(quiet=True, discard=steps // 5))
    effective = 0.8 * steps * start.shape[0] / time_steps
    return {"seconds": seconds, "acceptance": float(np.mean(sampler.acceptance_fraction)),
            "autocorrelation": float(time_steps), "effective_per_s": effective / seconds,
            "reliable": bool(steps > 50 * time_steps)}


def howl(build):
    text = subprocess.run([build + "/bench/family_bench", "--benchmark_format=json",
                           "--benchmark_filter=Enclose|Sample"],
                          check=True, capture_output=True, text=True).stdout
    return {b["name"]: b for b in json.loads(text)["benchmarks"]}


def main():
    rng = np.random.default_rng(1)
    ours = howl(sys.argv[1])
    enclose_s = ours["BM_Enclose/real_time"]["real_time"] * 1e-3
    sample = ours["BM_Sample/threads:1/real_time"]
    print(f"howl: bounds {enclose_s:.3f} s (guaranteed, excess "
          f"{100 * ours['BM_Enclose/real_time']['excess']:.2f} %), "
          f"{sample['effective_per_s']:.0f} effective members/s on one core")

    bounds, seconds, solves, failures = optimise_bounds(rng)
    print(f"scipy SLSQP: bounds {seconds:.2f} s, {solves} solves, {failures} failed, "
          f"{sum(v is None for v in bounds.values())} of 48 bounds not found; no guarantee")
    for k, name in ((0, "omega_hz exp1"), (5, "omega_hz exp6"), (11, "xi exp6"), (17, "N exp6")):
        print(f"   {name}: {bounds[k, -1]} .. {bounds[k, 1]}")
    print(f"   time ratio to howl: {seconds / enclose_s:.0f}")

    members = random_members(96, rng)
    for name, start, density, steps in (
            ("natural parameters", members, natural_log_density, 2000),
            ("howl's coordinates", None, reduced_log_density, 4000)):
        if start is None:
            start = np.hstack([members[:, 6:12], PHASE + errors(*np.split(members, 4, axis=1))[1]])
        r = ensemble(start, density, steps)
        note = "" if r["reliable"] else " (not converged: an upper limit)"
        print(f"emcee, {name}: acceptance {r['acceptance']:.4f}, autocorrelation "
              f"{r['autocorrelation']:.0f} steps, {r['effective_per_s']:.1f} effective members/s"
              f"{note}; ratio of howl {sample['effective_per_s'] / r['effective_per_s']:.0f}")


if __name__ == "__main__":
    main()
