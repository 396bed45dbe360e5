#include "estimation/analysis/cycle/growth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/analysis/spectra/line_phase.h"
#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

Growth EstimateGrowth(std::span<const double> p, double sampling_hz, double frequency_hz,
                      const GrowthOptions& options) {
  Growth growth;
  const int length = static_cast<int>(options.block_periods / frequency_hz * sampling_hz);
  const std::vector<double> x = RemoveMean(p);
  if (length < 8 || length * 8 > static_cast<int>(x.size())) return growth;
  const Blocks blocks = Demodulate(x, sampling_hz, frequency_hz, length);
  std::vector<double> envelope;
  for (const auto& z : blocks.amplitude) envelope.push_back(std::abs(z));
  const auto peak = std::max_element(envelope.begin(), envelope.end());

  // Goes back from the peak to where saturation begins, then to where the envelope leaves the
  // noise. Noise excites the mode the more the nearer it comes to growing, so the noise's level is
  // a high quantile of what precedes, the last fifth (growth itself) left out.
  auto end = peak;
  while (end != envelope.begin() && *end > options.below_peak * *peak) --end;
  if (end - envelope.begin() < 10) return growth;
  std::vector<double> before(envelope.begin(), envelope.begin() + (end - envelope.begin()) * 4 / 5);
  std::sort(before.begin(), before.end());
  const double noise = before[before.size() * 19 / 20];
  auto start = end;
  while (start != envelope.begin() && *start > options.above_noise * noise) --start;
  ++start;
  if (end - start < 5 || *end < 3.0 * *start) return growth;

  std::vector<double> log_envelope;
  for (auto it = start; it <= end; ++it) log_envelope.push_back(std::log(*it));
  const TrendFit trend = FitTrend(log_envelope);
  const auto first = static_cast<std::size_t>(start - envelope.begin());
  const auto count = static_cast<std::size_t>(end - start) + 1;
  const double change = trend.curvature.value * static_cast<double>(count) / 2.0;
  growth.rate_per_s = {trend.slope.value / blocks.hop_s,
                       std::hypot(trend.slope.std, change / std::sqrt(3.0)) / blocks.hop_s};
  // The frequency moves as soon as saturation begins to act, so it is taken from small amplitudes
  // where these suffice.
  std::size_t small = 0;
  while (small < count && envelope[first + small] < 0.15 * *peak) ++small;
  if (small < 6) small = count;
  const std::span<const std::complex<double>> window(blocks.amplitude.data() + first, small);
  const LineFrequency line = EstimateLineFrequency(window, UnwrapPhase(window), blocks.hop_s);
  growth.frequency_hz = {frequency_hz + line.offset_hz.value, line.offset_hz.std};
  growth.start_s = blocks.first_center_s + static_cast<double>(first) * blocks.hop_s;
  growth.end_s = growth.start_s + static_cast<double>(count - 1) * blocks.hop_s;
  growth.start_amplitude = *start;
  growth.end_amplitude = *end;
  growth.available = true;
  return growth;
}

}  // namespace howl
