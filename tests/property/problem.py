"""Problems drawn at random, whose loop is known exactly.

With s = 2 pi i f the loop of one experiment is (the paper, (1a) and (5a))

    G(s) = N s / (s^2 + 2 w xi s + w^2) + M s / (s^2 + 2 r w xi s + (r w)^2),   L = s G e^(-tau s)

The table's frequency is where arg L is 180 degrees, found here by bisection; the simulated cycle's,
which the flame's harmonics shift, is found by harmonic balance. Nothing of the program under test
is used to make its problem.
"""

import cmath
import math
import random
from dataclasses import dataclass

TWO_PI = 2.0 * math.pi


@dataclass
class Loop:
    """One experiment's loop; frequencies in Hz, N and M in (p per q) rad/s."""

    name: str
    phi: float
    omega_hz: float
    xi: float
    N: float
    M: float
    tau_s: float
    ratio: float
    loop_gain: float = 1.2
    frequency_hz: float = 0.0

    def acoustics(self, frequency_hz):
        s = 2j * math.pi * frequency_hz
        total = 0.0
        for coefficient, omega in ((self.N, self.omega_hz), (self.M, self.ratio * self.omega_hz)):
            w = TWO_PI * omega
            total += coefficient * s / (s * s + 2.0 * w * self.xi * s + w * w)
        return total

    def loop_phase_error(self, frequency_hz):
        """arg L less 180 degrees, in radians within half a turn."""
        s = 2j * math.pi * frequency_hz
        value = -s * self.acoustics(frequency_hz) * cmath.exp(-self.tau_s * s)
        return cmath.phase(value)

    def gain(self):
        return abs(self.acoustics(self.frequency_hz))

    def phase_deg(self):
        return math.degrees(cmath.phase(self.acoustics(self.frequency_hz)))

    def flame_slope(self):
        return -self.loop_gain / (TWO_PI * self.frequency_hz * self.gain())


@dataclass
class Problem:
    seed: int
    modes: int
    shared_delay: bool
    loops: list


def crossing(loop, low_hz, high_hz):
    """The frequency in [low_hz, high_hz] nearest to the first mode's at which arg L passes 180
    degrees downwards, or None."""
    steps = 200
    grid = [low_hz + (high_hz - low_hz) * i / steps for i in range(steps + 1)]
    found = []
    for low, high in zip(grid, grid[1:]):
        before, after = loop.loop_phase_error(low), loop.loop_phase_error(high)
        if not (after <= 0.0 < before and before - after < math.pi):
            continue
        for _ in range(100):
            middle = 0.5 * (low + high)
            if loop.loop_phase_error(middle) > 0.0:
                low = middle
            else:
                high = middle
        found.append(0.5 * (low + high))
    return min(found, key=lambda f: abs(f - loop.omega_hz), default=None)


HARMONICS = 15
SAMPLES = 128  # of a period: what tanh gives beyond the 49th harmonic is below rounding here
ANGLES = [TWO_PI * i / SAMPLES for i in range(SAMPLES)]


def harmonics_of_flame(rate, slope):
    """Q_k, k = 1 .. HARMONICS, of q = -tanh(slope v) for v = Re sum V_k e^(j k theta); saturation 1,
    rate and q normed so that slope is of unit argument. Odd harmonics only: tanh is odd."""
    odd = range(1, HARMONICS + 1, 2)
    values = []
    for angle in ANGLES:
        v = sum((rate[k] * cmath.exp(1j * k * angle)).real for k in odd)
        values.append(-math.tanh(slope * v))
    return {k: 2.0 / SAMPLES * sum(q * cmath.exp(-1j * k * a) for q, a in zip(values, ANGLES))
            for k in odd}


def cycle_frequency_hz(loop):
    """Frequency of the limit cycle with a tanh flame of this loop's slope (the paper, section 3.2):
    V_k = L(j k w) Q_k for every harmonic. The fundamental's equation is solved for amplitude and
    frequency by Newton with differences, the higher harmonics, small, by iteration."""
    slope = abs(loop.flame_slope())

    def response(frequency_hz):
        s = 2j * math.pi * frequency_hz
        return s * loop.acoustics(frequency_hz) * cmath.exp(-loop.tau_s * s)

    def mismatch(amplitude, frequency_hz):
        rate = {k: 0.0 for k in range(1, HARMONICS + 1, 2)}
        rate[1] = amplitude
        q = harmonics_of_flame(rate, slope)
        for _ in range(30):
            largest = 0.0
            for k in range(3, HARMONICS + 1, 2):
                value = response(k * frequency_hz) * q[k]
                largest = max(largest, abs(value - rate[k]))
                rate[k] = value
            q = harmonics_of_flame(rate, slope)
            if largest < 1e-12 * amplitude:
                break
        return response(frequency_hz) * q[1] / amplitude - 1.0

    amplitude = 2.0 * math.sqrt(max(loop.loop_gain - 1.0, 0.01)) / slope
    frequency = loop.frequency_hz
    for _ in range(30):
        here = mismatch(amplitude, frequency)
        da, df = 1e-6 * amplitude, 1e-6 * frequency
        by_a = (mismatch(amplitude + da, frequency) - here) / da
        by_f = (mismatch(amplitude, frequency + df) - here) / df
        determinant = by_a.real * by_f.imag - by_a.imag * by_f.real
        step_a = (here.real * by_f.imag - here.imag * by_f.real) / determinant
        step_f = (by_a.real * here.imag - by_a.imag * here.real) / determinant
        limit = min(1.0, 0.3 * amplitude / max(abs(step_a), 1e-300))
        amplitude -= limit * step_a
        frequency -= limit * step_f
        if abs(step_f) < 1e-10 * frequency and abs(step_a) < 1e-8 * amplitude:
            return frequency
    return None


def draw_loops(rng, modes, shared_delay):
    """Loops as the paper describes its rig: the cycle near the first mode, which carries it; xi
    grows with phi; omega nearly the same; the delay near three quarters of a period (3). None where
    a draw has no such cycle."""
    count = rng.choice([2, 3, 4])
    base_hz = rng.uniform(120.0, 300.0)
    xi = rng.uniform(0.03, 0.10)
    N = rng.uniform(200.0, 800.0) * base_hz / 200.0
    # The second mode adds little at the first one's cycle (5b), and the cycle near it stays
    # linearly stable: its loop gain is well below one.
    ratio_of_coefficients = rng.uniform(0.02, 0.15) if modes == 2 else 0.0
    periods = rng.uniform(0.70, 0.745)
    tau = periods / base_hz
    loops = []
    for k in range(count):
        loop = Loop(
            name=f"exp{k + 1}",
            phi=round(0.50 + 0.02 * k, 2),
            omega_hz=base_hz * rng.uniform(0.97, 1.03),
            xi=xi,
            N=N * rng.uniform(0.8, 1.25),
            M=0.0,
            tau_s=tau if shared_delay else tau * math.exp(rng.gauss(0.0, 0.01)),
            ratio=3.0,
            loop_gain=rng.uniform(1.15, 1.6),
        )
        loop.M = ratio_of_coefficients * N  # one for all experiments, as the model has it
        xi *= rng.uniform(1.0, 1.3)
        frequency = crossing(loop, 0.8 * loop.omega_hz, 1.25 * loop.omega_hz)
        if frequency is None or abs(loop.loop_phase_error(frequency)) > 1e-6:
            return None
        loop.frequency_hz = frequency
        if abs(loop.phase_deg()) > 60.0:
            return None
        # No second cycle: the loop's gain at rest near the second mode stays below one.
        slope = abs(loop.flame_slope())
        for i in range(200):
            f = loop.omega_hz * (2.0 + 0.01 * i * 1.5)
            if TWO_PI * f * abs(loop.acoustics(f)) * slope > 0.9:
                return None
        loops.append(loop)
    spread = max(l.omega_hz for l in loops) / min(l.omega_hz for l in loops) - 1.0
    return loops if spread < 0.2 and max(l.xi for l in loops) < 0.28 else None


def draw(seed):
    """Problem number `seed`: modes and the delay's scope alternate, so that all four occur."""
    rng = random.Random(seed)
    modes = 1 + seed % 2
    shared_delay = (seed // 2) % 2 == 0
    while True:
        loops = draw_loops(rng, modes, shared_delay)
        if loops:
            return Problem(seed, modes, shared_delay, loops)


def held_parameters(problem):
    """`parameters` that hold every loop at its drawn values: what is simulated is the drawn loop."""
    lines = ["parameters:", "  tau_s: {scope: experiment}"]
    if problem.modes == 2:
        lines.append("  M: {scope: experiment}")
    for loop in problem.loops:
        values = {"omega_hz": loop.omega_hz, "xi": loop.xi, "N": loop.N, "tau_s": loop.tau_s}
        if problem.modes == 2:
            values["M"] = loop.M
        lines += [f"  {loop.name}.{key}: {{initial: {value!r}, fixed: true}}"
                  for key, value in values.items()]
    return "\n".join(lines) + "\n"


def free_parameters(problem):
    scope = "shared" if problem.shared_delay else "experiment"
    return f"parameters:\n  tau_s: {{scope: {scope}}}\n"


def config_text(problem, parameters):
    """The config of the problem's table: exact characteristics, no records."""
    lines = [f"title: property problem {problem.seed}", "experiments:"]
    for loop in problem.loops:
        lines.append(
            f"  - {{name: {loop.name}, phi: {loop.phi}, frequency_hz: {loop.frequency_hz!r},"
            f" phase_deg: {loop.phase_deg()!r}, gain: {loop.gain()!r},"
            f" flame_slope: {loop.flame_slope()!r}}}"
        )
    lines.append(f"model: {{modes: {problem.modes}, harmonic_ratio: 3}}")
    return "\n".join(lines) + "\n" + parameters
