// A record whose p is q's through a resonance, and its sensor's noise.
#ifndef HOWL_TESTS_ESTIMATION_ANALYSIS_RESONANT_RECORD_H_
#define HOWL_TESTS_ESTIMATION_ANALYSIS_RESONANT_RECORD_H_

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

#include "estimation/analysis/spectra/record.h"

namespace howl {

struct ResonantRecord {
  static constexpr double kCycleHz = 200.0;
  static constexpr double kNoise = 0.01;  // of p's sensor
  static constexpr double kPole = 0.98;   // at 5 kHz, a radius; it rings for two periods
};

// q with a cycle whose phase wanders, and broad noise.
inline Record MakeResonantRecord(std::uint64_t seed, double rate_hz, std::size_t samples) {
  constexpr double kRateOfPole = 5000.0;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Record out{.sampling_hz = rate_hz};
  const double turn = 2.0 * std::numbers::pi * ResonantRecord::kCycleHz / rate_hz;
  const double step = kRateOfPole / rate_hz;
  const double pole = std::pow(ResonantRecord::kPole, step);
  double phase = 0.0;
  double before = 0.0;
  double last = 0.0;
  for (std::size_t t = 0; t < samples; ++t) {
    phase += turn + 0.01 * std::sqrt(step) * normal(random);
    const double q = std::sin(phase) + 0.2 * std::sin(2.0 * phase) + 0.3 * normal(random);
    const double p =
        2.0 * pole * std::cos(1.1 * turn) * last - pole * pole * before + 0.05 * step * step * q;
    before = last;
    last = p;
    out.heat_release.push_back(q);
    out.pressure.push_back(p + ResonantRecord::kNoise * normal(random));
  }
  return out;
}

}  // namespace howl

#endif  // HOWL_TESTS_ESTIMATION_ANALYSIS_RESONANT_RECORD_H_
