"""What a classifier sees of a rig: spectra, transfer, harmonics, fluctuations and sample statistics of
p and q, each as mean, scatter and trend over the experiments."""
import numpy as np
from scipy.signal import csd, hilbert, welch

from rigs import SAMPLING_HZ

BANDS = np.linspace(20, 2480, 33)


def in_bands(frequencies, values):
    place = np.digitize(frequencies, BANDS)
    return np.array([np.mean(values[place == k]) for k in range(1, len(BANDS))])


def of_channel(x):
    """Harmonics, other lines, envelope, and the samples' own statistics."""
    x = x - np.mean(x)
    size = len(x)
    spectrum = np.abs(np.fft.rfft(x * np.hanning(size))) * 4 / size
    hz = np.fft.rfftfreq(size, 1 / SAMPLING_HZ)
    peak = np.argmax(spectrum * (hz > 100))
    f, top = hz[peak], spectrum[peak]
    around = lambda at, width: np.append(spectrum[np.abs(hz - at) <= width], 1e-12 * top)
    harmonics = [np.log(np.max(around(k * f, 3)) / top + 1e-9) for k in (2, 3, 4, 5)]
    harmonic = np.min(np.abs(hz[:, None] - f * np.arange(0, 12)), axis=1) < 25
    rest = np.where(harmonic, 0, spectrum)
    floor = np.median(rest[rest > 0])
    other = np.argmax(rest)
    lines = [np.log(rest[other] / top + 1e-9), np.log(rest[other] / floor), hz[other] / 1000]
    lines += [np.log(np.max(around(hum, 1.5)) / np.median(around(hum, 25)))
              for hum in (50, 60, 100, 120)]
    band = np.fft.rfft(x)
    band[(hz < 0.6 * f) | (hz > 1.4 * f)] = 0
    analytic = hilbert(np.fft.irfft(band, size))[size // 20:-size // 20]
    envelope = np.abs(analytic)
    rate = np.diff(np.unwrap(np.angle(analytic))) * SAMPLING_HZ / (2 * np.pi)
    slow = envelope - np.mean(envelope)
    correlation = np.fft.irfft(np.abs(np.fft.rfft(slow, 2 * len(slow))) ** 2)[:len(slow)]
    memory = np.argmax(correlation < 0.37 * correlation[0])
    third = len(rate) // 3
    motion = [np.std(envelope) / np.mean(envelope), np.log(memory + 1),
              np.min(envelope) / np.mean(envelope), np.max(envelope) / np.mean(envelope),
              np.std(rate) / f, (np.mean(rate[-third:]) - np.mean(rate[:third])) / f,
              (np.mean(envelope[-third:]) - np.mean(envelope[:third])) / np.mean(envelope)]
    reach = np.max(x) - np.min(x)
    levels = np.unique(x)
    sample = [np.mean(x**4) / np.mean(x**2) ** 2, np.mean(x**3) / np.mean(x**2) ** 1.5,
              np.mean(x > np.max(x) - 1e-3 * reach), np.mean(x < np.min(x) + 1e-3 * reach),
              np.log(len(levels) / size), np.log(np.median(np.diff(levels)) / reach + 1e-12)]
    return [f / 200] + harmonics + lines + motion + sample


def of_experiment(p, q):
    hz, spp = welch(p, SAMPLING_HZ, nperseg=512)
    _, sqq = welch(q, SAMPLING_HZ, nperseg=512)
    _, sqp = csd(q, p, SAMPLING_HZ, nperseg=512)
    transfer = sqp / sqq
    total = in_bands(hz, np.abs(transfer))
    turned = transfer / np.abs(transfer)
    return np.concatenate([
        in_bands(hz, np.log(spp / np.sum(spp) + 1e-15)),
        in_bands(hz, np.log(sqq / np.sum(sqq) + 1e-15)),
        np.log(total + 1e-12), in_bands(hz, turned.real), in_bands(hz, turned.imag),
        in_bands(hz, np.abs(sqp) ** 2 / (spp * sqq)), of_channel(p), of_channel(q)])


def of_rig(records):
    rows = np.array([of_experiment(p, q) for p, q in records])
    place = np.linspace(-1, 1, len(rows))
    trend = place @ rows / np.sum(place**2)
    return np.nan_to_num(np.concatenate([rows.mean(axis=0), rows.std(axis=0), trend]))
