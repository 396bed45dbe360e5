#include "estimation/growth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/line_blocks.h"
#include "estimation/spectrum.h"

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

  // Last block below the saturation's foot before the peak, then back down to the noise. The quiet
  // part is taken as the first half of what precedes the foot: growth fills little of it.
  auto end = peak;
  while (end != envelope.begin() && *end > options.below_peak * *peak) --end;
  if (end - envelope.begin() < 6) return growth;
  const std::span<const double> before(envelope.begin(), end);
  const double noise = Median(before.first(std::max<std::size_t>(before.size() / 2, 3)));
  auto start = end;
  while (start != envelope.begin() && *start > options.above_noise * noise) --start;
  ++start;
  if (end - start < 5 || *end < 3.0 * *start) return growth;

  std::vector<double> log_envelope;
  for (auto it = start; it <= end; ++it) log_envelope.push_back(std::log(*it));
  const TrendFit trend = FitTrend(log_envelope);
  growth.rate_per_s = {trend.slope.value / blocks.hop_s, trend.slope.std / blocks.hop_s};
  const auto first = static_cast<std::size_t>(start - envelope.begin());
  const auto count = static_cast<std::size_t>(end - start) + 1;
  const std::span<const std::complex<double>> window(blocks.amplitude.data() + first, count);
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
