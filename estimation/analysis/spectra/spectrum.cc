#include "estimation/analysis/spectra/spectrum.h"

#include <glog/logging.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "model/numerics/constants.h"
#include "model/numerics/fft.h"

namespace howl {
namespace {

int Hop(int segment) { return std::max(segment / 4, 1); }

}  // namespace

std::vector<double> HannWindow(int length) {
  std::vector<double> window(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i) {
    window[static_cast<std::size_t>(i)] = 0.5 - 0.5 * std::cos(kTwoPi * (i + 0.5) / length);
  }
  return window;
}

std::vector<double> BlackmanHarrisWindow(int length) {
  std::vector<double> window(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i) {
    const double a = kTwoPi * i / length;
    window[static_cast<std::size_t>(i)] =
        0.35875 - 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) - 0.01168 * std::cos(3 * a);
  }
  return window;
}

std::vector<double> RemoveMean(std::span<const double> x) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) /
                      static_cast<double>(std::max<std::size_t>(x.size(), 1));
  std::vector<double> result(x.begin(), x.end());
  for (double& value : result) value -= mean;
  return result;
}

std::vector<std::complex<double>> RealFft(std::span<const double> x) {
  std::vector<std::complex<double>> result(x.size() / 2 + 1);
  Fft().Forward(x, result);
  return result;
}

double CrossSpectrum::DegreesOfFreedom(int bins) const {
  const std::vector<double> window = BlackmanHarrisWindow(segment);
  double power = 0.0;
  for (double w : window) power += w * w;
  const int hop = Hop(segment);
  double sum = 0.0;
  for (int d = 0; d * hop < segment && d < segments; ++d) {
    for (int m = 0; m < std::min(bins, 2 * kBlackmanHarrisMainLobeBins); ++m) {
      const std::complex<double> step = std::polar(1.0, kTwoPi * m / segment);
      const std::size_t shift = static_cast<std::size_t>(d) * static_cast<std::size_t>(hop);
      std::complex<double> phasor = 1.0, overlap = 0.0;
      for (int t = 0; t + d * hop < segment; ++t) {
        overlap += phasor * (window[static_cast<std::size_t>(t)] *
                             window[static_cast<std::size_t>(t) + shift]);
        phasor *= step;
      }
      sum += std::norm(overlap) / (power * power) * (segments - d) * (bins - m) *
             (d == 0 ? 1.0 : 2.0) * (m == 0 ? 1.0 : 2.0);
    }
  }
  const double count = static_cast<double>(segments) * bins;
  return count * count / sum;
}

namespace {

// A power of two near the largest value; one where all are zero.
double PowerOfTwo(std::span<const double> x) {
  double largest = 0.0;
  for (const double value : x) largest = std::max(largest, std::abs(value));
  return largest > 0.0 && std::isfinite(largest) ? std::exp2(std::ilogb(largest)) : 1.0;
}

}  // namespace

CrossSpectrum WelchSpectrum(std::span<const double> p, std::span<const double> q,
                            double sampling_hz, int segment) {
  CHECK(q.empty() || q.size() == p.size());
  const int n = static_cast<int>(p.size());
  CHECK_GE(n, 32);
  if (segment == 0) {
    segment = static_cast<int>(std::bit_floor(static_cast<unsigned>(n / 3.5)));
  }
  CHECK_LE(segment, n);
  CrossSpectrum spectrum;
  spectrum.segment = segment;
  spectrum.bin_hz = sampling_hz / segment;
  const int bins = segment / 2 + 1;
  spectrum.pp.assign(static_cast<std::size_t>(bins), 0.0);
  if (!q.empty()) {
    spectrum.qq.assign(static_cast<std::size_t>(bins), 0.0);
    spectrum.qp.assign(static_cast<std::size_t>(bins), 0.0);
  }

  const std::vector<double> window = BlackmanHarrisWindow(segment);
  double power = 0.0;
  for (double w : window) power += w * w;
  Fft fft;
  // Both channels in one complex transform: z = p + j q, each at an amplitude of about one, as the
  // rounding of the larger would drown the smaller. By powers of two, which keep every bit.
  const double p_unit = PowerOfTwo(p), q_unit = PowerOfTwo(q);
  std::vector<std::complex<double>> z(static_cast<std::size_t>(segment)), transform(z.size());
  for (int start = 0; start + segment <= n; start += Hop(segment)) {
    for (int t = 0; t < segment; ++t) {
      const auto i = static_cast<std::size_t>(start) + static_cast<std::size_t>(t);
      const double w = window[static_cast<std::size_t>(t)];
      z[static_cast<std::size_t>(t)] = {w * (p[i] / p_unit), q.empty() ? 0.0 : w * (q[i] / q_unit)};
    }
    fft.Forward(z, transform);
    for (int k = 0; k < bins; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const std::complex<double> a = transform[i];
      const std::complex<double> b =
          std::conj(transform[static_cast<std::size_t>((segment - k) % segment)]);
      const std::complex<double> pk = 0.5 * (a + b);
      spectrum.pp[i] += std::norm(pk);
      if (q.empty()) continue;
      const std::complex<double> qk = std::complex<double>(0.0, -0.5) * (a - b);
      spectrum.qq[i] += std::norm(qk);
      spectrum.qp[i] += std::conj(qk) * pk;
    }
    ++spectrum.segments;
  }
  const double scale = 2.0 / (sampling_hz * power * spectrum.segments);
  for (double& s : spectrum.pp) s *= scale * (p_unit * p_unit);
  for (double& s : spectrum.qq) s *= scale * (q_unit * q_unit);
  for (std::complex<double>& s : spectrum.qp) s *= scale * (p_unit * q_unit);
  spectrum.degrees_of_freedom = spectrum.DegreesOfFreedom(1);
  return spectrum;
}

namespace {

template <typename T>
Blocks DemodulateSamples(std::span<const T> x, double sampling_hz, double frequency_hz,
                         int length) {
  length = std::max(length - length % 2, 4);
  const int n = static_cast<int>(x.size());
  CHECK_LE(length, n);
  const int hop = length / 2;
  const std::vector<double> window = HannWindow(length);
  Blocks blocks;
  blocks.hop_s = hop / sampling_hz;
  blocks.length_s = length / sampling_hz;
  blocks.first_center_s = 0.5 * (length - 1) / sampling_hz;
  const double radians_per_sample = -kTwoPi * frequency_hz / sampling_hz;
  const std::complex<double> step = std::polar(1.0, radians_per_sample);
  for (int start = 0; start + length <= n; start += hop) {
    // A fresh phasor each block keeps the recurrence's rounding error negligible.
    std::complex<double> phasor = std::polar(1.0, std::fmod(radians_per_sample * start, kTwoPi));
    std::complex<double> sum = 0.0;
    for (int t = 0; t < length; ++t) {
      sum += phasor * (window[static_cast<std::size_t>(t)] *
                       x[static_cast<std::size_t>(start) + static_cast<std::size_t>(t)]);
      phasor *= step;
    }
    blocks.amplitude.push_back(sum * (4.0 / length));  // sum of Hann weights: length / 2
  }
  return blocks;
}

}  // namespace

Blocks Demodulate(std::span<const double> x, double sampling_hz, double frequency_hz, int length) {
  return DemodulateSamples(x, sampling_hz, frequency_hz, length);
}

Blocks Demodulate(std::span<const std::complex<double>> x, double sampling_hz, double frequency_hz,
                  int length) {
  return DemodulateSamples(x, sampling_hz, frequency_hz, length);
}

}  // namespace howl
