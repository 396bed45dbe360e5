#include "estimation/analysis/spectra/line_phase.h"

#include <algorithm>
#include <cmath>

#include "estimation/analysis/spectra/spectrum.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

LineFrequency PulsePair(std::span<const std::complex<double>> blocks, double hop_s) {
  LineFrequency line;
  std::vector<double> scores;
  std::complex<double> sum = 0.0;
  double power = 0.0;
  for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
    sum += blocks[b + 1] * std::conj(blocks[b]);
    power += 0.5 * (std::norm(blocks[b]) + std::norm(blocks[b + 1]));
  }
  if (blocks.size() < 6 || !(std::abs(sum) > 0.0)) return line;
  const double mean = std::abs(sum) / static_cast<double>(blocks.size() - 1);
  for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
    scores.push_back(
        (blocks[b + 1] * std::conj(blocks[b]) * std::conj(sum) / std::abs(sum)).imag() / mean);
  }
  const MeanError error = ErrorOfMean(scores, 0.0);
  const double to_hz = 1.0 / (kRadPerSPerHz * hop_s);
  line.offset_hz = {std::arg(sum) * to_hz, std::sqrt(error.covariance(0, 0)) * to_hz *
                                               StudentInflation(error.degrees_of_freedom)};
  // |sum| / power falls as e^(-D hop / 2) under phase diffusion D, and by one sixth for noise
  // alone.
  line.diffusion_rad2_per_s = -2.0 * std::log(std::min(std::abs(sum) / power, 1.0)) / hop_s;
  return line;
}

}  // namespace

PhaseSeries UnwrapPhase(std::span<const std::complex<double>> blocks) {
  PhaseSeries series;
  double largest = 0.0;
  double power = 0.0;
  for (const auto& z : blocks) power += std::norm(z) / static_cast<double>(blocks.size());
  double weakest = power;
  std::complex<double> mean_step = 0.0;
  for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
    mean_step += blocks[b + 1] * std::conj(blocks[b]);
  }
  const double expected = std::arg(mean_step);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    weakest = std::min(weakest, std::norm(blocks[b]));
    if (b == 0) {
      series.phase_rad.push_back(std::arg(blocks[0]));
      continue;
    }
    const double step = std::arg(blocks[b] * std::conj(blocks[b - 1]) * std::polar(1.0, -expected));
    largest = std::max(largest, std::abs(step));
    series.phase_rad.push_back(series.phase_rad.back() + expected + step);
  }
  series.reliable = blocks.size() >= 6 && largest < 2.2 && weakest > 0.04 * power;
  return series;
}

LineFrequency EstimateLineFrequency(std::span<const std::complex<double>> blocks,
                                    const PhaseSeries& phase, double hop_s) {
  if (!phase.reliable) return PulsePair(blocks, hop_s);
  const TrendFit trend = FitTrend(phase.phase_rad);
  const double to_hz = 1.0 / (kRadPerSPerHz * hop_s);
  LineFrequency line;
  line.offset_hz = {trend.slope.value * to_hz, trend.slope.std * to_hz};
  line.drift_hz_per_s = {trend.curvature.value * to_hz / hop_s,
                         trend.curvature.std * to_hz / hop_s};
  // A frequency that drifts is not one number. Another stretch may differ by as much as the drift,
  // beyond its own error, spreads it over the record (the deviation of a uniform distribution).
  const double drift = std::sqrt(
      std::max(line.drift_hz_per_s.value * line.drift_hz_per_s.value -
                   kNormal95 * kNormal95 * line.drift_hz_per_s.std * line.drift_hz_per_s.std,
               0.0));
  const double duration_s = static_cast<double>(blocks.size()) * hop_s;
  line.offset_hz.std = std::hypot(line.offset_hz.std, drift * duration_s / std::sqrt(12.0));
  line.diffusion_rad2_per_s = trend.walk_variance / hop_s;
  return line;
}

}  // namespace howl
