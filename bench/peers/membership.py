"""The conditions that a member of R228's family passes (configs/r228.yaml), written from docs/family.md.

Arrays of omega_hz, xi, N and tau_s have the experiments in their last axis. All six experiments,
or some of them: `which`.
"""
import numpy as np

import r228

GAIN_TOL, PHASE_TOL, LOOP_TOL = 0.01, np.radians(0.5), np.radians(1.0)
LOOP_GAIN_MIN, SPREAD, XI_MAX = 1.0, 0.25, 0.3
ALL = tuple(range(6))
PARAMETERS = ["omega_hz", "xi", "N", "tau_s"]


def errors(omega_hz, xi, n, tau_s, which=ALL):
    """Errors of gain, phase and loop phase, (5c) and (1a), and the response's magnitude."""
    k = list(which)
    o = 2 * np.pi * omega_hz
    z = n / (2 * o * xi + 1j * (r228.W[k] - o * o / r228.W[k]))
    phase = np.angle(z)
    return (np.abs(z) / r228.GAIN[k] - 1, phase - r228.PHASE[k],
            1.5 * np.pi + phase - r228.W[k] * tau_s, np.abs(z))


def margins(omega_hz, xi, n, tau_s, which=ALL):
    """Every condition as something that must not be negative, each in units of its tolerance."""
    k = list(which)
    gain, phase, loop, size = errors(omega_hz, xi, n, tau_s, which)
    sure = r228.RELIABLE[k]
    loop_gain = (r228.W * np.abs(r228.FLAME_SLOPE))[k][sure] * size[..., sure]
    parts = [1 - gain / GAIN_TOL, 1 + gain / GAIN_TOL, 1 - phase / PHASE_TOL,
             1 + phase / PHASE_TOL, 1 - loop / LOOP_TOL, 1 + loop / LOOP_TOL,
             1 - xi / XI_MAX, xi / XI_MAX, loop_gain / LOOP_GAIN_MIN - 1]
    if len(k) > 1:
        window = 1 + SPREAD - np.max(omega_hz, axis=-1) / np.min(omega_hz, axis=-1)
        # phi falls along the table, and xi does not fall as phi grows.
        parts += [(xi[..., :-1] - xi[..., 1:]) / XI_MAX, window[..., None] / SPREAD]
    return np.concatenate(parts, axis=-1)


def is_member(omega_hz, xi, n, tau_s, which=ALL):
    return np.all(margins(omega_hz, xi, n, tau_s, which) >= 0, axis=-1)


def random_members(count, rng):
    """Some members of all six, as rows of 24: within nine tenths of the tolerances."""
    found = []
    while len(found) < count:
        xi = np.sort(rng.uniform(0.01, XI_MAX, 6) * rng.uniform())[::-1]
        member = r228.closed_form(xi, r228.PHASE + PHASE_TOL * rng.uniform(-0.9, 0.9, 6),
                                  r228.GAIN * (1 + GAIN_TOL * rng.uniform(-0.9, 0.9, 6)),
                                  LOOP_TOL * rng.uniform(-0.9, 0.9, 6))
        if is_member(*member):
            found.append(np.concatenate(member))
    return np.array(found)


def config(which=ALL, family="members: 10"):
    """configs/r228.yaml with these experiments."""
    lines = ["experiments:"]
    for k in which:
        reliable = "" if r228.RELIABLE[k] else ", reliable: false"
        lines.append("  - {name: %s, phi: %r, frequency_hz: %r, phase_deg: %r, gain: %r, "
                     "flame_slope: %r%s}" % (
                         r228.NAMES[k], *(float(column[k]) for column in (
                             r228.PHI, r228.FREQUENCY_HZ, r228.PHASE_DEG, r228.GAIN,
                             r228.FLAME_SLOPE)), reliable))
    test = ("{gain_tolerance: 0.01, phase_tolerance_deg: 0.5, loop_phase_tolerance_deg: 1.0, "
            "loop_gain_min: 1.0, omega_spread_max: 0.25, xi_max: 0.3, xi_increasing: true}")
    return "\n".join([*lines, "family: {%s, test: %s}" % (family, test), ""])


def bounds_of(answer, which=ALL, kind="outer"):
    """{(experiment, parameter): (low, high)} of a family.json."""
    found = {}
    for k in which:
        for parameter in PARAMETERS:
            found[k, parameter] = tuple(answer["bounds"][r228.NAMES[k]][parameter][kind])
    return found
