#include "estimation/analysis/flame/flame_regressor.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kLeastDiffusion = 5e-12;  // rad^2 a period: a steadier phase counts as this steady
constexpr double kHighestHarmonic = 0.4;   // of the sampling rate

// Samples of the blocks that p's fundamental is joined from. Long ones let in less noise of p's own
// (a relative variance of 0.4 |n|^2 / |P|^2, falling as 1 / length), short ones follow a wandering
// phase (an error of about 0.1 D length) and whatever else q is coherent with. A whole number of
// periods, three at least, keeps harmonics out.
int JoiningBlock(const Characteristics& cycle, double sampling_hz) {
  const double longest_s = cycle.block_samples / sampling_hz;
  const double noise = 0.4 * cycle.floor_incoherent_share * cycle.block_noise_power * longest_s /
                       (cycle.p_amplitude * cycle.p_amplitude);
  const double diffusion =
      std::max(kRadPerSPerHz * cycle.line_width_hz, kLeastDiffusion * cycle.frequency_hz.value);
  const double best_s = std::min(std::sqrt(noise / (0.1 * diffusion)), longest_s);
  const double periods = std::max(std::round(best_s * cycle.frequency_hz.value), 3.0);
  return static_cast<int>(std::lround(periods / cycle.frequency_hz.value * sampling_hz));
}

}  // namespace

FlameRegressor::FlameRegressor(const Record& record, const Characteristics& cycle, double tau_s,
                               int max_harmonic)
    : frequency_hz_(cycle.frequency_hz.value),
      sampling_hz_(record.sampling_hz),
      tau_s_(tau_s),
      block_samples_(JoiningBlock(cycle, record.sampling_hz)) {
  CHECK_GT(cycle.p_amplitude, 0.0);
  const std::vector<double> p = RemoveMean(record.pressure);
  blocks_ = Demodulate(p, sampling_hz_, frequency_hz_, block_samples_);
  const double first_s = blocks_.first_center_s;
  const double last_s = first_s + static_cast<double>(blocks_.amplitude.size() - 1) * blocks_.hop_s;
  const int n = static_cast<int>(p.size());
  first_ = std::max(static_cast<int>(std::ceil((first_s + tau_s) * sampling_hz_)), 0);
  last_ = std::min(static_cast<int>(std::floor((last_s + tau_s) * sampling_hz_)), n);

  // The error in the slope by the harmonics beyond, whose contribution is taken to halve with each
  // order.
  double tail = 0.0;
  for (int order = 2; order <= max_harmonic; ++order) {
    if (order * frequency_hz_ > kHighestHarmonic * sampling_hz_) break;
    tail *= 0.5;
    const Blocks harmonic = Demodulate(p, sampling_hz_, order * frequency_hz_, block_samples_);
    std::complex<double> mean = 0.0;
    double power = 0.0;
    const auto count = static_cast<double>(harmonic.amplitude.size());
    for (std::size_t b = 0; b < harmonic.amplitude.size(); ++b) {
      const double angle = std::arg(blocks_.amplitude[b]);
      const std::complex<double> locked = harmonic.amplitude[b] * std::polar(1.0, -order * angle);
      mean += locked / count;
      power += std::norm(locked) / count;
    }
    const double variance_of_mean = std::max(power - std::norm(mean), 0.0) / count;
    const double slope_error = order * order * std::sqrt(variance_of_mean) / cycle.p_amplitude;
    harmonic_slope_variance_ += 0.5 * slope_error * slope_error;
    // The harmonic is shrunk to zero by its own uncertainty; a small one that is left out is missed
    // in the slope.
    if (std::norm(mean) <= variance_of_mean) continue;
    mean *= 1.0 - variance_of_mean / std::norm(mean);
    tail = std::max(tail, order * order * std::abs(mean) / cycle.p_amplitude);
    // j k w m_k (P_1 / |P_1|)^k with P_1 / |P_1| = -j F / |F|, F = j w P_1.
    const std::complex<double> j(0.0, 1.0);
    locked_.push_back(
        {order, j * (order * kRadPerSPerHz * frequency_hz_) * mean * std::pow(-j, order)});
  }
  // The contribution of the last one, in a flame whose odd orders fall to a quarter each.
  constexpr double kBeyond = 0.5;
  harmonic_slope_variance_ += kBeyond * kBeyond * tail * tail;
}

std::complex<double> FlameRegressor::Fundamental(int sample) const {
  const double time_s = sample / sampling_hz_ - tau_s_;
  const double position = (time_s - blocks_.first_center_s) / blocks_.hop_s;
  const auto b =
      std::min(static_cast<std::size_t>(std::max(position, 0.0)), blocks_.amplitude.size() - 2);
  // Hann's weights, which sum to one.
  const double next = 0.5 - 0.5 * std::cos(std::numbers::pi * (position - static_cast<double>(b)));
  const std::complex<double> amplitude =
      blocks_.amplitude[b] * (1.0 - next) + blocks_.amplitude[b + 1] * next;
  const double w = kRadPerSPerHz * frequency_hz_;
  return std::complex<double>(0.0, w) * amplitude * std::polar(1.0, w * time_s);
}

double FlameRegressor::Harmonics(const std::complex<double>& fundamental) const {
  const std::complex<double> unit = fundamental / std::abs(fundamental);
  std::complex<double> power = unit;
  int order = 1;
  double sum = 0.0;
  for (const LockedHarmonic& harmonic : locked_) {
    for (; order < harmonic.order; ++order) power *= unit;
    sum += (harmonic.rate * power).real();
  }
  return sum;
}

}  // namespace howl
