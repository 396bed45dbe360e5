// Method `paper` (characteristics.h).
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "estimation/analysis/cycle/characteristics.h"
#include "model/numerics/units.h"

namespace howl {

Characteristics PaperCharacteristics(std::span<const double> p, std::span<const double> q,
                                     double sampling_hz, double min_frequency_hz,
                                     double max_frequency_hz) {
  const std::vector<std::complex<double>> fp = RealFft(p), fq = RealFft(q);
  const double bin_hz = sampling_hz / static_cast<double>(p.size());
  const auto first = static_cast<std::size_t>(std::ceil(min_frequency_hz / bin_hz));
  const auto last = std::min(static_cast<std::size_t>(max_frequency_hz / bin_hz), fp.size() - 6);
  std::size_t best = std::max<std::size_t>(first, 5);
  for (std::size_t k = best; k <= last; ++k) {
    if (std::norm(fp[k]) > std::norm(fp[best])) best = k;
  }
  double weights = 0.0, gain = 0.0, phase = 0.0;
  const double reference = std::arg(fp[best] / fq[best]);
  for (std::size_t k = best - 5; k <= best + 5; ++k) {
    const double weight = std::abs(fp[k]);
    const std::complex<double> ratio = fp[k] / fq[k];
    weights += weight;
    gain += weight * std::abs(ratio);
    phase += weight * std::arg(ratio * std::polar(1.0, -reference));  // no jump at 180 degrees
  }
  Characteristics result;
  result.frequency_hz.value = static_cast<double>(best) * bin_hz;
  result.phase_deg.value = WrapDeg((reference + phase / weights) * kDegPerRad);
  result.gain.value = gain / weights;
  return result;
}

}  // namespace howl
