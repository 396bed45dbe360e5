#!/usr/bin/env python3
"""Where the band of a loop's likelihood has to end below an anti-alias filter.

    python3 bench/band_end_study.py [NOISE] [CYCLES]

p and q of a cycle pass the same filter before they are sampled. What is linear in the loop does not
notice; a flame does: the curve of the filtered p is not what the filter makes of the curve. For
cycles of 10 to 40 samples and flames saturated as rigs' are, even and not, the study prints by how
much the right curve of the filtered p misses the filtered q: the largest at any harmonic in bands
that end at several shares of the sampling rate, over the first harmonic of q.

It is compared with what noise leaves of a line: NOISE sqrt(2 / samples), NOISE (0.02) being the
combustion noise over q and a record having CYCLES (5000) cycles of 13 samples. It falls with the
root of the record's length, the filter's error does not: ten times longer records ask for a filter
three times as flat where the band ends. Needs numpy.
"""
import math
import sys

import numpy as np

FINE = 4096  # points a cycle
BAND_ENDS = [0.25, 0.30, 0.33, 0.35, 0.37, 0.40]
INPUT_END = 0.40  # of the sampling rate: how far recorded p drives the flame
MOST_OF_CYCLE = 6.4  # of the cycle's frequency: where a band ends in any case
MOST_HARMONICS = 40  # which a filter leaves something of


def windowed_sinc(f, half=0.44, reach=14.0):
    """Real, by f over the sampling rate: under Blackman's window, half lost at `half`."""
    t = np.arange(0.0, reach + 1e-9, 0.05)
    window = 0.42 + 0.5 * np.cos(np.pi * t / reach) + 0.08 * np.cos(2.0 * np.pi * t / reach)
    taps = np.sinc(2.0 * half * t) * window
    taps /= taps[0] + 2.0 * taps[1:].sum()
    return taps[0] + 2.0 * (taps[1:, None] * np.cos(2.0 * np.pi * t[1:, None] * f)).sum(0)


def kaiser_sinc(f):
    """Flat within 1e-4 to 0.4, 80 dB down from 0.6, as howl simulate's (model/simulation)."""
    reach = 12.5
    t = np.arange(0.0, reach + 1e-9, 0.05)
    taps = np.sinc(t) * np.i0(7.86 * np.sqrt(np.maximum(1.0 - (t / reach) ** 2, 0.0)))
    taps /= taps[0] + 2.0 * taps[1:].sum()
    return taps[0] + 2.0 * (taps[1:, None] * np.cos(2.0 * np.pi * t[1:, None] * f)).sum(0)


def butterworth(f, half=0.39, order=8):
    """An analog one, 3 dB down at `half`; its delay at low frequencies is taken out."""
    poles = np.exp(1j * np.pi * (2.0 * np.arange(order) + order + 1.0) / (2.0 * order))
    s = 1j * f / half
    response = np.prod([1.0 / (1.0 - s / pole) for pole in poles], axis=0)
    return response * np.exp(s * np.sum(-1.0 / poles).real)


FILTERS = {
    "none": np.ones_like,
    "sinc, Kaiser, half lost at 0.5": kaiser_sinc,
    "sinc, Blackman, at 0.44": windowed_sinc,
    "Butterworth, order 8, at 0.39": butterworth,
}


def left(response, samples, bias, amplitude, band_end):
    """What the right curve of recorded p leaves of q: the largest at a harmonic, over q's first."""
    angle = 2.0 * np.pi * np.arange(FINE) / FINE
    rate = np.cos(angle) - 0.06 * np.cos(3.0 * angle + 0.5) + 0.03 * np.cos(2.0 * angle)
    harmonics = np.arange(FINE // 2 + 1)
    dulled = response(harmonics[:MOST_HARMONICS] / samples)
    dulled = np.concatenate([dulled, np.zeros(len(harmonics) - MOST_HARMONICS)])
    q = dulled * np.fft.rfft(np.tanh(bias + amplitude * rate))
    driving = np.fft.rfft(rate) * dulled * (harmonics <= INPUT_END * samples)
    of_recorded = np.fft.rfft(np.tanh(bias + amplitude * np.fft.irfft(driving, FINE)))
    band = (harmonics >= 1) & (harmonics <= min(band_end * samples, MOST_OF_CYCLE))
    return np.abs(q - of_recorded)[band].max() / np.abs(q[1])


def main():
    noise = float(sys.argv[1]) if len(sys.argv) > 1 else 0.02
    cycles = float(sys.argv[2]) if len(sys.argv) > 2 else 5000.0
    print(f"noise leaves of a line: {noise * math.sqrt(2.0 / (13.0 * cycles)):.1e}\n")
    print("filter                        " + "".join(f"{end:>9}" for end in BAND_ENDS))
    for name, response in FILTERS.items():
        worst = [max(left(response, samples, bias, amplitude, end)
                     for samples in np.arange(10.0, 40.5, 0.5)
                     for bias in (0.0, 0.25) for amplitude in (1.2, 1.8)) for end in BAND_ENDS]
        print(f"{name:30}" + "".join(f"{each:9.1e}" for each in worst))


if __name__ == "__main__":
    main()
