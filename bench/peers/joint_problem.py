"""The residuals of howl's joint fit of test R228, written again from the paper's equations.

Unknowns are the natural logarithms of omega_hz, xi and N of the six experiments, with two modes of
the shared M, of tau_s of the six experiments, and of the means of omega_hz and of tau_s. With
s = j 2 pi f and U(omega, xi) = s / (s^2 + 2 omega xi s + omega^2),

  G = N U(omega, xi) + M U(3 omega, xi),   L = s G e^(-tau s)

and each residual is in standard deviations, docs/config.md has the list. The functions work on
numpy arrays as well as on CasADi's symbols: `lib` has log, exp, atan2, fmax and stack of either.
"""
import types

import numpy as np

import r228

NUMPY = types.SimpleNamespace(log=np.log, exp=np.exp, sqrt=np.sqrt, cos=np.cos, sin=np.sin,
                              atan2=np.arctan2, fmax=np.fmax, stack=np.concatenate)
DEGREE = np.pi / 180
UNRELIABLE_WEIGHT = 0.25
# Start scatter, as a factor either way (JointProblem::Start).
SCATTER = {"omega_hz": 1.2, "xi": 5.0, "N": 5.0, "M": 5.0, "tau_s": 1.1}


class Problem:
    """modes: 1 is configs/r228.yaml, 2 is configs/r228_two_modes.yaml."""

    def __init__(self, modes):
        self.modes = modes
        self.xi_typical, self.xi_std = (0.1, 1.0) if modes == 1 else (0.2, 0.5)
        self.kinds = ["omega_hz", "xi", "N"] + (["M"] if modes == 2 else []) + ["tau_s"]
        sizes = [1 if kind == "M" else 6 for kind in self.kinds] + [1, 1]
        ends = np.cumsum(sizes)
        self.parts = dict(zip(self.kinds + ["omega_hz_mean", "tau_s_mean"],
                              [slice(int(b - a), int(b)) for a, b in zip(sizes, ends)]))
        self.size = int(ends[-1])
        self.labels, self.weights = self._labels()
        self.root_weight = np.sqrt(self.weights)

    def _labels(self):
        names, lines = r228.NAMES, [f"{n} 750 Hz" for n in r228.NAMES[:4]]
        # A fall of xi belongs to the less reliable of the two, else to the one at higher phi.
        owners = ["exp1", "exp2", "exp3", "exp5", "exp6"]
        table = [("gain_equality", names), ("phase_equality", names),
                 ("limit_cycle_gain", names[:4]), ("limit_cycle_phase", names),
                 ("damping_prior", names), ("omega_prior", names), ("tau_prior", names),
                 ("xi_increasing", owners)]
        if self.modes == 2:
            table += [("second_crossing", lines), ("second_mode_minor", names),
                      ("second_crossing_gain", lines)]
        labels = [f"{kind} {name}" for kind, owned in table for name in owned]
        unreliable = [name for name, fine in zip(names, r228.RELIABLE) if not fine]
        weights = [UNRELIABLE_WEIGHT if any(n in label for n in unreliable) else 1.0
                   for label in labels]
        return labels, np.array(weights)

    def bounds(self):
        """Logarithms of the config's bounds and of howl's guard rails (search_range.cc)."""
        low, high = np.full(self.size, -np.inf), np.full(self.size, np.inf)
        coefficient = r228.W * r228.GAIN
        rails = {"omega_hz": (r228.FREQUENCY_HZ.min() / 1e3, r228.FREQUENCY_HZ.max() * 1e3),
                 "xi": (1e-4, 10.0),
                 "N": (coefficient.min() / 1e9, coefficient.max() * 1e9),
                 "M": (coefficient.min() / 1e9, 5000.0),
                 "tau_s": (1e-4 / r228.FREQUENCY_HZ.max(), 1e3 / r228.FREQUENCY_HZ.min())}
        if self.modes == 2:
            rails["omega_hz"] = (150.0, rails["omega_hz"][1])
            rails["xi"] = (0.02, 10.0)
        for name, part in self.parts.items():
            low[part], high[part] = np.log(rails[name.removesuffix("_mean")])
        return low, high

    def start(self, rng=None, power=1):
        """The closed form at xi = 0.1, scattered as howl scatters its own starts; power: as many
        times as far in the logarithm."""
        omega_hz, xi, n, tau_s = r228.closed_form(0.1)
        values = {"omega_hz": omega_hz, "xi": xi, "N": n, "tau_s": tau_s,
                  "M": [np.exp(np.mean(np.log(0.4 * n)))]}
        logs = np.zeros(self.size)
        low, high = self.bounds()
        for kind in self.kinds:
            part = self.parts[kind]
            logs[part] = np.log(values[kind])
            if rng is not None:
                scatter = power * np.log(SCATTER[kind])
                logs[part] += scatter * rng.uniform(-1, 1, logs[part].size)
        logs = np.clip(logs, low + 1e-9, high - 1e-9)  # a printed value must be inside
        for kind in ("omega_hz", "tau_s"):
            logs[self.parts[kind + "_mean"]] = np.mean(logs[self.parts[kind]])
        return logs

    def residuals(self, logs, lib=NUMPY):
        """Each in standard deviations, in the order of `labels`; `weights` are not applied."""
        x = {kind: lib.exp(logs[self.parts[kind]]) for kind in self.kinds}
        log = {name: logs[part] for name, part in self.parts.items()}
        w, slope, reliable = r228.W, np.abs(r228.FLAME_SLOPE), slice(0, 4)
        first = unit_mode(2 * np.pi * x["omega_hz"], x["xi"], w)
        second = unit_mode(6 * np.pi * x["omega_hz"], x["xi"], w)
        re, im = self._response(x, first, second)
        squared = re * re + im * im
        turned = (re * np.cos(r228.PHASE) + im * np.sin(r228.PHASE),
                  im * np.cos(r228.PHASE) - re * np.sin(r228.PHASE))
        gain_short = 1 - (slope * w)[reliable] * lib.sqrt(squared)[reliable]
        fall = x["xi"][1:6] - x["xi"][0:5]
        rows = [0.5 / 0.01 * lib.log(squared / r228.GAIN**2),
                lib.atan2(turned[1], turned[0]) / (0.5 * DEGREE),
                lib.fmax(0, gain_short) / 0.05,
                loop_phase(re, im, w, x["tau_s"], lib) / DEGREE,
                (log["xi"] - np.log(self.xi_typical)) / self.xi_std,
                (log["omega_hz"] - log["omega_hz_mean"]) / 0.05,
                (log["tau_s"] - log["tau_s_mean"]) / 0.03,
                lib.fmax(0, fall) / 0.02]
        if self.modes == 2:
            rows += self._second_crossing(x, first, second, slope, lib)
        return lib.stack(rows)

    def _response(self, x, first, second):
        if self.modes == 1:
            return x["N"] * first[0], x["N"] * first[1]
        return tuple(x["N"] * a + x["M"] * b for a, b in zip(first, second))

    def _second_crossing(self, x, first, second, slope, lib):
        """Section 4 of the paper at the line, and (5b) at the limit cycle."""
        share = x["M"] / x["N"] * lib.sqrt(squared_magnitude(second) / squared_magnitude(first))
        four = {kind: x[kind] if kind == "M" else x[kind][0:4] for kind in self.kinds}
        w = 2 * np.pi * r228.LINE_HZ * np.ones(4)
        re, im = self._response(four, unit_mode(2 * np.pi * four["omega_hz"], four["xi"], w),
                                unit_mode(6 * np.pi * four["omega_hz"], four["xi"], w))
        std = DEGREE * np.hypot(5.0, 360 * r228.TAU_OF_PHASE_S[:4] * r228.LINE_STD_HZ)
        short = 1 - slope[:4] * w * lib.sqrt(re * re + im * im)
        return [loop_phase(re, im, w, four["tau_s"], lib) / std,
                lib.fmax(0, share - 0.1) / 0.01, lib.fmax(0, short) / 0.05]

    def weighted(self, logs, lib=NUMPY):
        return self.root_weight * self.residuals(logs, lib)

    def cost(self, logs):
        return 0.5 * float(np.sum(self.weighted(logs) ** 2))

    def logs_of(self, solution):
        """The unknowns of a solution.json that howl fit wrote."""
        logs = np.zeros(self.size)
        for kind in self.kinds:
            values = [e[kind] for e in solution["experiments"]]
            logs[self.parts[kind]] = np.log(values[:1] if kind == "M" else values)
        for name in ("omega_hz_mean", "tau_s_mean"):
            logs[self.parts[name]] = np.log(shared_value(solution, name))
        return logs


def unit_mode(omega_rad_s, xi, w):
    a, b = 2 * omega_rad_s * xi, w - omega_rad_s * omega_rad_s / w
    return a / (a * a + b * b), -b / (a * a + b * b)


def squared_magnitude(z):
    return z[0] * z[0] + z[1] * z[1]


def loop_phase(re, im, w, tau_s, lib):
    """arg L less half a turn, wrapped: the angle of -j (re + j im) e^(-j w tau)."""
    c, s = lib.cos(w * tau_s), lib.sin(w * tau_s)
    return lib.atan2(-(c * re + s * im), c * im - s * re)


def shared_value(solution, name):
    if name in solution["shared"]:
        return solution["shared"][name]
    return next(p["value"] for p in solution["parameters"] if p["name"] == name)
