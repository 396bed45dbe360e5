// Records of two oscillations with known truth. The cycle
//
//   p = A(t) cos theta(t),   q = A(t) / g cos(theta(t) - phase)
//
// has A = 1 + m cos theta_s and theta = w t + beta sin(theta_s + 1) + a random walk; the slow one
// adds S cos theta_s to p and its own share to q. Or a second acoustic one stands beside it, with a
// gain and a phase of its own. White noise on each channel.
#ifndef HOWL_TESTS_ESTIMATION_ANALYSIS_TWO_OSCILLATION_RECORD_H_
#define HOWL_TESTS_ESTIMATION_ANALYSIS_TWO_OSCILLATION_RECORD_H_

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "estimation/analysis/spectra/record.h"

namespace howl::fixtures {

struct TwoOscillations {
  double sampling_hz = 5000.0;
  double duration_s = 4.0;
  double frequency_hz = 250.0;
  double phase_deg = -20.0;  // from q to p
  double gain = 13.0;        // |p| / |q|
  double diffusion_rad2_per_s = 1.0;
  double noise = 0.1;  // rms over each channel's part of the cycle
  // A slow one; amplitudes over the cycle's in the same channel.
  double slow_hz = 10.0;
  double slow_in_p = 0.0, slow_in_q = 0.0;
  double amplitude_modulation = 0.0;  // m
  double phase_modulation_rad = 0.0;  // beta
  double slow_diffusion_rad2_per_s = 0.2;
  // A second acoustic one.
  double other_hz = 305.0;
  double other_in_p = 0.0;
  double other_gain = 6.0;
  double other_phase_deg = 40.0;
};

inline Record Synthesise(const TwoOscillations& o, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi);
  const double step_s = 1.0 / o.sampling_hz;
  const double rad = std::numbers::pi / 180.0;
  double walk = turn(random), slow = turn(random), other = turn(random);
  Record record{o.sampling_hz, {}, {}};
  const int samples = static_cast<int>(o.duration_s * o.sampling_hz);
  for (int t = 0; t < samples; ++t) {
    const double amplitude = 1.0 + o.amplitude_modulation * std::cos(slow);
    const double theta = walk + o.phase_modulation_rad * std::sin(slow + 1.0);
    double p = amplitude * std::cos(theta) + o.slow_in_p * std::cos(slow + 0.3);
    double q = amplitude * std::cos(theta - o.phase_deg * rad) + o.slow_in_q * std::cos(slow);
    p += o.other_in_p * std::cos(other);
    q += o.gain / o.other_gain * o.other_in_p * std::cos(other - o.other_phase_deg * rad);
    record.pressure.push_back(p + o.noise * normal(random));
    record.heat_release.push_back((q + o.noise * normal(random)) / o.gain);
    const double diffusion = std::sqrt(o.diffusion_rad2_per_s * step_s);
    walk += 2.0 * std::numbers::pi * o.frequency_hz * step_s + diffusion * normal(random);
    other += 2.0 * std::numbers::pi * o.other_hz * step_s + diffusion * normal(random);
    slow += 2.0 * std::numbers::pi * o.slow_hz * step_s +
            std::sqrt(o.slow_diffusion_rad2_per_s * step_s) * normal(random);
  }
  return record;
}

}  // namespace howl::fixtures

#endif  // HOWL_TESTS_ESTIMATION_ANALYSIS_TWO_OSCILLATION_RECORD_H_
