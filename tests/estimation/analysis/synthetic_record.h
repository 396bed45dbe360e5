// Records with known truth: a cycle p = A m(t) cos theta(t) whose phase may diffuse and whose
// amplitude may breathe, a saturating flame q = -s S tanh(x / S) driven by x(t) = 2 pi f p taken
// tau - 1 / (4 f) earlier, further lines, and coloured noise on each channel.
#ifndef HOWL_TESTS_ESTIMATION_ANALYSIS_SYNTHETIC_RECORD_H_
#define HOWL_TESTS_ESTIMATION_ANALYSIS_SYNTHETIC_RECORD_H_

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "estimation/analysis/spectra/record.h"

namespace howl::fixtures {

struct SyntheticOptions {
  double sampling_hz = 5000.0;
  int samples = 16000;
  double frequency_hz = 210.0;
  double phase_deg = -10.0;
  double gain = 13.0;
  double p_amplitude = 5.0;
  // Phi'(0) times 2 pi f gain: above one the flame saturates so that the gain comes out as given;
  // one is a linear flame.
  double loop_gain = 1.0;
  double q_offset = 0.0;
  double diffusion_rad2_per_s = 0.0;
  double breathing = 0.0;         // standard deviation of m, about one
  double breathing_time_s = 0.1;  // its correlation time
  double noise = 0.1;             // rms over the fundamental's amplitude, in each channel
  double noise_pole = 0.0;        // 0: white
  double second_harmonic = 0.0;   // of p and q, relative
  double line_ratio = 0.0;        // further line at this multiple of f; 0: none
  double line_amplitude = 0.2;    // relative, in both channels
};

struct SyntheticRecord {
  Record record;
  double tau_s = 0.0;
  double flame_slope = 0.0;
  double line_hz = 0.0;
};

// First Fourier coefficient of S tanh(r cos) / (S r): the describing function over the slope.
inline double TanhDescribingFunction(double r) {
  constexpr int kPoints = 256;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double c = std::cos(2.0 * M_PI * (i + 0.5) / kPoints);
    sum += std::tanh(r * c) * c;
  }
  return 2.0 * sum / kPoints / r;
}

// The drive over the saturation scale at which the describing function is 1 / loop_gain.
inline double DriveOverScale(double loop_gain) {
  double low = 1e-6, high = 1e3;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (TanhDescribingFunction(middle) > 1.0 / loop_gain ? low : high) = middle;
  }
  return low;
}

inline SyntheticRecord Synthesise(const SyntheticOptions& o, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  SyntheticRecord out;
  out.record.sampling_hz = o.sampling_hz;
  const double w = 2.0 * M_PI * o.frequency_hz;
  out.tau_s = (270.0 + o.phase_deg) / (360.0 * o.frequency_hz);
  out.flame_slope = -o.loop_gain / (o.gain * w);
  out.line_hz = o.line_ratio * o.frequency_hz;
  const double shift = (out.tau_s - 0.25 / o.frequency_hz) * o.sampling_hz;  // samples
  const int margin = static_cast<int>(std::ceil(std::abs(shift))) + 2;
  const int n = o.samples;

  // Phase and envelope, with a margin on both sides for the delay.
  std::vector<double> theta, m;
  const double step = std::sqrt(o.diffusion_rad2_per_s / o.sampling_hz);
  double walk = std::uniform_real_distribution<double>(0.0, 2.0 * M_PI)(random);
  const double pole = std::exp(-1.0 / (o.breathing_time_s * o.sampling_hz));
  double breath = normal(random);
  for (int t = -margin; t < n + margin; ++t) {
    theta.push_back(walk + w * t / o.sampling_hz);
    m.push_back(std::max(1.0 + o.breathing * breath, 0.05));
    walk += step * normal(random);
    breath = pole * breath + std::sqrt(1.0 - pole * pole) * normal(random);
  }
  const auto at = [&](const std::vector<double>& x, double t) {
    const double index = t + margin;
    const auto i = static_cast<std::size_t>(index);
    const double fraction = index - static_cast<double>(i);
    return x[i] + fraction * (x[i + 1] - x[i]);
  };
  const double drive = o.loop_gain > 1.0 ? DriveOverScale(o.loop_gain) : 0.0;
  const double scale = o.loop_gain > 1.0 ? w * o.p_amplitude / drive : 0.0;
  const double q_amplitude = o.p_amplitude / o.gain;
  const double line_phase = 6.0 * std::generate_canonical<double, 53>(random);
  double p_noise = normal(random), q_noise = normal(random);
  const double innovation = std::sqrt(1.0 - o.noise_pole * o.noise_pole);
  for (int t = 0; t < n; ++t) {
    const double a = at(theta, t), b = at(theta, t - shift);
    const double x = w * o.p_amplitude * at(m, t - shift) * std::cos(b);
    double q = out.flame_slope * (scale > 0.0 ? scale * std::tanh(x / scale) : x);
    double p = o.p_amplitude * at(m, t) * std::cos(a);
    p += o.second_harmonic * o.p_amplitude * std::cos(2.0 * a + 1.0);
    q += o.second_harmonic * q_amplitude * std::cos(2.0 * b + 2.0);
    if (o.line_ratio > 0.0) {
      const double c = 2.0 * M_PI * out.line_hz * t / o.sampling_hz + line_phase;
      p += o.line_amplitude * o.p_amplitude * std::cos(c);
      q += o.line_amplitude * q_amplitude * std::cos(c + 1.0);
    }
    p_noise = o.noise_pole * p_noise + innovation * normal(random);
    q_noise = o.noise_pole * q_noise + innovation * normal(random);
    out.record.pressure.push_back(p + o.noise * o.p_amplitude * p_noise);
    out.record.heat_release.push_back(o.q_offset + q + o.noise * q_amplitude * q_noise);
  }
  return out;
}

}  // namespace howl::fixtures

#endif  // HOWL_TESTS_ESTIMATION_ANALYSIS_SYNTHETIC_RECORD_H_
