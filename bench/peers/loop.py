"""The loop of the paper in time and on its limit cycle, for the comparisons of simulations.

One or two modes, each N_m s / (s^2 + 2 xi w_m s + w_m^2), as states p_m and z_m with

  p_m' = N_m q - 2 xi w_m p_m - w_m^2 z_m,   z_m' = p_m,   p = sum of p_m,   q = Phi(p'(t - tau))

and Phi(v) = tanh(k v), k < 0. p' has q in it, so that the delay equation is of neutral type.
"""
import dataclasses

import numpy as np
from scipy.optimize import fsolve, least_squares


@dataclasses.dataclass
class Loop:
    omega_hz: float
    xi: float
    n: float
    m: float
    tau_s: float
    slope: float

    def modes(self):
        """(coefficient, natural frequency in rad/s) of each."""
        w = 2 * np.pi * self.omega_hz
        return [(self.n, w)] + ([(self.m, 3 * w)] if self.m else [])

    def response(self, s):
        """G(s), from q to p."""
        return sum(c * s / (s * s + 2 * w * self.xi * s + w * w) for c, w in self.modes())

    def flame(self, v):
        return np.tanh(self.slope * v)

    def config(self, simulate):
        """A config in which nothing is left to be fitted. Its data are those of the loop: with M of 0
        the phase and gain of G at the cycle."""
        f = describing_function(self)[0]
        g = self.response(2j * np.pi * f)
        second = "" if not self.m else f"\n  M: {{initial: {self.m!r}, fixed: true}}"
        return "\n".join([
            "experiments:",
            f"  - {{name: exp1, phi: 0.56, frequency_hz: {f:.6f}, phase_deg: "
            f"{np.degrees(np.angle(g)):.6f}, gain: {abs(g):.8g}, flame_slope: {self.slope!r}}}",
            f"model: {{modes: {len(self.modes())}, harmonic_ratio: 3}}", "parameters:",
            f"  omega_hz: {{initial: {self.omega_hz!r}, fixed: true}}",
            f"  xi: {{initial: {self.xi!r}, fixed: true}}",
            f"  N: {{initial: {self.n!r}, fixed: true}}{second}",
            f"  tau_s: {{initial: {self.tau_s!r}, fixed: true}}",
            f"simulate: {simulate}", ""])


# Experiment 1 of R228 near howl's fit, and the loop of the paper's section 4 with M / N = 0.5.
LOOPS = {"one mode": Loop(216.6, 0.15, 4981.0, 0.0, 0.00334, -0.703e-4),
         "two modes": Loop(215.0, 0.2, 6609.0, 3304.5, 0.00346, -0.703e-4)}


def describing_function(loop, near_hz=218.0):
    """Frequency and amplitude of p in the cycle, by the flame's first harmonic alone."""
    angles = (np.arange(256) + 0.5) * 2 * np.pi / 256

    def balance(x):
        s = 2j * np.pi * x[0]
        gain = np.mean(loop.flame(x[1] * np.sin(angles)) * np.sin(angles)) * 2 / x[1]
        error = s * loop.response(s) * np.exp(-s * loop.tau_s) * gain - 1
        return [error.real, error.imag]

    f, rate = fsolve(balance, [near_hz, 1.0 / abs(loop.slope)], xtol=1e-12)
    return float(f), float(abs(rate / (2 * np.pi * f)))


def fourier_cycle(loop, samples=256):
    """The cycle to rounding: p' at equidistant phases, by all harmonics below samples / 2.

    Returns the frequency, the amplitude of p's first harmonic, and p's harmonics from zero.
    """
    f0, amplitude = describing_function(loop)
    k = np.fft.rfftfreq(samples, 1 / samples)
    phase = 2 * np.pi * np.arange(samples) / samples
    scale = 2 * np.pi * f0 * amplitude

    def harmonics(v, f):
        s = 2j * np.pi * f * k
        delayed = np.fft.irfft(np.fft.rfft(v) * np.exp(-s * loop.tau_s), samples)
        return loop.response(np.where(k == 0, 1, s)) * (k > 0) * np.fft.rfft(loop.flame(delayed))

    def residual(x):
        v, f = x[:-1] * scale, x[-1] * f0
        rate = np.fft.irfft(2j * np.pi * f * k * harmonics(v, f), samples)
        return np.append((v - rate) / scale, np.sum(v * np.cos(phase)) / (samples * scale))

    x = least_squares(residual, np.append(np.sin(phase), 1.0), xtol=1e-15, ftol=1e-15,
                      gtol=1e-15).x
    p = harmonics(x[:-1] * scale, x[-1] * f0) * 2 / samples
    return float(x[-1] * f0), float(abs(p[1])), p


def line_of(p, sampling_hz, near_hz, harmonics=7):
    """Frequency and amplitude of the first harmonic of a periodic record without noise."""
    t = np.arange(len(p)) / sampling_hz
    count = min(harmonics, int(0.4 * sampling_hz / near_hz))

    def fit(f):
        angle = 2 * np.pi * f * t[:, None] * np.arange(1, count + 1)
        basis = np.hstack([np.ones((len(t), 1)), np.cos(angle), np.sin(angle)])
        weights, *_ = np.linalg.lstsq(basis, p, rcond=None)
        return weights, p - basis @ weights

    f = least_squares(lambda x: fit(x[0] * near_hz)[1], [1.0], xtol=1e-15, ftol=1e-15,
                      gtol=1e-15, diff_step=1e-7).x[0] * near_hz
    weights = fit(f)[0]
    return float(f), float(np.hypot(weights[1], weights[1 + count]))
