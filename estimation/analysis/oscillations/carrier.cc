#include "estimation/analysis/oscillations/carrier.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

constexpr double kSidebandShare = 0.1;  // of the carrier's spectrum
constexpr double kSidebandReach = 3.5;  // slow frequencies on either side hold most of the power

// False where there are no sidebands.
bool MoveToCarrier(const CrossSpectrum& spectrum, double slow_hz, SpectralPeak* peak) {
  const auto power_at = [&](double hz) {
    const int middle = static_cast<int>(std::lround(hz / spectrum.bin_hz));
    double highest = 0.0;
    for (int k = std::max(middle - 2, 0);
         k <= std::min(middle + 2, static_cast<int>(spectrum.pp.size()) - 1); ++k) {
      highest = std::max(highest, spectrum.pp[static_cast<std::size_t>(k)]);
    }
    return highest;
  };
  const double f = peak->frequency_hz;
  if (std::max(power_at(f - slow_hz), power_at(f + slow_hz)) < kSidebandShare * power_at(f)) {
    return false;
  }
  for (int pass = 0; pass < 3; ++pass) {
    double sum = 0.0, moment = 0.0;
    const double reach = kSidebandReach * slow_hz;
    for (std::size_t k = 1; k < spectrum.pp.size(); ++k) {
      const double hz = spectrum.Frequency(static_cast<int>(k));
      if (std::abs(hz - peak->frequency_hz) > reach) continue;
      const double above = std::max(spectrum.pp[k] - peak->noise_psd, 0.0);
      sum += above;
      moment += above * hz;
    }
    if (!(sum > 0.0)) break;
    peak->frequency_hz = moment / sum;
    peak->power = sum * spectrum.bin_hz;
  }
  return true;
}

}  // namespace

std::optional<SlowOscillation> ModulationOf(const Record& record, const CrossSpectrum& spectrum,
                                            std::span<const OscillationLine> lines,
                                            SpectralPeak* peak) {
  std::optional<SlowOscillation> slow = SlowBeside(record, lines, peak->frequency_hz);
  if (!slow || !MoveToCarrier(spectrum, slow->frequency_hz, peak)) return std::nullopt;
  return slow;
}

}  // namespace howl
