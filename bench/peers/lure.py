"""A discrete-time, time-delayed Lur'e model estimated by least squares.

After the description of Paredes and Bernstein, "Identification of Self-Excited Systems Using Discrete-
Time, Time-Delayed Lur'e Models" (arXiv 2004.14488): linear dynamics, a delay, a washout filter and a
static continuous piecewise-linear feedback, with a constant for the bias,

  y_k = -D_1 y_(k-1) - ... - D_n y_(k-n) + B_1 v_(k-1) + ... + B_n v_(k-n) + c,
  v_k = N(y_f,k),   y_f,k = y_(k-d) - y_(k-d-1),

of the output y alone. As implemented here: N is a sum of hat functions on nodes spread over the range
of y_f with slopes that go on beyond them, the products of B_i and N's values at the nodes are estimated
by linear least squares together with D and c, and their matrix is replaced by its nearest of rank one
(singular vectors), after which D, c and the factors are refined in turns, each by linear least squares.
n and d are those of a grid whose free run comes nearest to the record's line, on the record it was
estimated from.
"""
import numpy as np


def hats(x, nodes):
    """Values of the hat functions at x, one column a node; linear beyond the ends."""
    place = np.clip(np.searchsorted(nodes, x) - 1, 0, len(nodes) - 2)
    share = (x - nodes[place]) / (nodes[place + 1] - nodes[place])
    out = np.zeros((len(x), len(nodes)))
    rows = np.arange(len(x))
    out[rows, place] = 1 - share
    out[rows, place + 1] = share
    return out


class Lure:
    def __init__(self, y, order, delay, num_nodes=9, turns=8):
        self.order, self.delay = order, delay
        feedback = np.concatenate([np.zeros(delay + 1), np.diff(y)])[:len(y)]
        reach = np.max(np.abs(feedback[delay + 1:]))
        # An even number of intervals: zero is a node, where N is zero (its constant is c's).
        self.nodes = np.linspace(-reach, reach, num_nodes)
        keep = np.arange(num_nodes) != num_nodes // 2
        first = order + delay + 1
        target = y[first:]
        past = np.stack([y[first - i:len(y) - i] for i in range(1, order + 1)], axis=1)
        basis = hats(feedback, self.nodes)[:, keep]
        shifted = np.stack([basis[first - i:len(y) - i] for i in range(1, order + 1)], axis=1)
        one = np.ones((len(target), 1))
        solve = lambda parts: np.linalg.lstsq(np.hstack(parts), target, rcond=None)[0]
        theta = solve([past, shifted.reshape(len(target), -1), one])
        products = theta[order:-1].reshape(order, -1)
        left, size, right = np.linalg.svd(products)
        b, values = left[:, 0] * size[0], right[0]
        for _ in range(turns):
            theta = solve([past, shifted @ values, one])
            b = theta[order:-1]
            theta = solve([past, np.einsum("kij,i->kj", shifted, b), one])
            values = theta[order:-1]
        self.d, self.b, self.constant = theta[:order], b, theta[-1]
        self.values = np.zeros(num_nodes)
        self.values[keep] = values

    def nonlinearity(self, x):
        i = min(max(int(np.searchsorted(self.nodes, x)) - 1, 0), len(self.nodes) - 2)
        share = (x - self.nodes[i]) / (self.nodes[i + 1] - self.nodes[i])
        return self.values[i] + share * (self.values[i + 1] - self.values[i])

    def free_run(self, y, length):
        """From the first samples of y on, by itself; None where it diverges."""
        n, d = self.order, self.delay
        first = n + d + 1
        out = list(y[:first])
        v = [0.0] * first
        for k in range(d + 1, first):
            v[k] = self.nonlinearity(out[k - d] - out[k - d - 1])
        limit = 1e3 * np.max(np.abs(y))
        weights = list(self.d) + list(self.b)
        for k in range(first, length):
            state = out[k - n:k][::-1] + v[k - n:k][::-1]
            value = self.constant + sum(w * s for w, s in zip(weights, state))
            if not abs(value) < limit:
                return None
            out.append(value)
            v.append(self.nonlinearity(out[k - d] - out[k - d - 1]))
        return np.array(out)

    def mode(self, sampling_hz, near_hz):
        """Natural frequency and damping ratio of the pole pair of the linear part nearest to a
        frequency; not a number where no pair oscillates."""
        poles = np.log(np.roots(np.append(1.0, -self.d)).astype(complex))
        poles = poles[np.imag(poles) > 0] * sampling_hz
        if not len(poles):
            return np.nan, np.nan
        pole = min(poles, key=lambda s: abs(abs(s) / (2 * np.pi) - near_hz))
        return abs(pole) / (2 * np.pi), -np.real(pole) / abs(pole)


def line(y, sampling_hz, harmonics=3):
    """Frequency and amplitude of the strongest line: the peak of a long transform, refined."""
    y = y - np.mean(y)
    size = 16 * len(y)
    spectrum = np.abs(np.fft.rfft(y * np.hanning(len(y)), size))
    peak = int(np.argmax(spectrum[1:-1])) + 1
    a, b, c = np.log(spectrum[peak - 1:peak + 2] + 1e-300)
    f = (peak + 0.5 * (a - c) / (a - 2 * b + c)) * sampling_hz / size
    angle = 2 * np.pi * f * np.arange(len(y))[:, None] / sampling_hz * np.arange(1, harmonics + 1)
    weights = np.linalg.lstsq(np.hstack([np.cos(angle), np.sin(angle)]), y, rcond=None)[0]
    return float(f), float(np.hypot(weights[0], weights[harmonics]))


def identify(y, sampling_hz, orders, delays):
    """The model of the grid whose free run has the line nearest to that of y: sum of the relative
    errors of frequency and amplitude, the former counted ten times."""
    wanted = line(y, sampling_hz)
    best = (np.inf, None)
    for order in orders:
        for delay in delays:
            model = Lure(y, order, delay)
            run = model.free_run(y, min(len(y), int(0.6 * sampling_hz)))
            if run is None:
                continue
            f, amplitude = line(run[len(run) // 2:], sampling_hz)
            miss = 10 * abs(f / wanted[0] - 1) + abs(amplitude / wanted[1] - 1)
            if miss < best[0]:
                best = (miss, model)
    return best[1]
