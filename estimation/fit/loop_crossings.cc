#include "estimation/fit/loop_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/analysis/transfer/transfer.h"
#include "model/numerics/units.h"

namespace howl {

std::vector<ObservedCrossing> LoopCrossings(const Experiment& experiment, const LoopModel& model,
                                            const ModelSpec& spec) {
  constexpr double kBeyondLine = 1.2;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double highest_hz = TransferBandOf(spec, experiment.frequency_hz).max_frequency_hz;
  std::vector<double> observed = {experiment.frequency_hz};
  for (const ObservedLine& line : experiment.lines) {
    observed.push_back(line.frequency_hz);
    highest_hz = std::max(highest_hz, kBeyondLine * line.frequency_hz);
  }
  const LoopParameters<double> loop = model.Loop();
  const auto gain_at = [&](double frequency_hz) {
    return experiment.flame_slope ? LoopGain(loop, frequency_hz, *experiment.flame_slope)
                                  : kUnknown;
  };
  std::vector<ObservedCrossing> result;
  for (PhaseCrossing& crossing :
       PhaseCrossings(loop, experiment.flame_slope.value_or(-1.0), highest_hz)) {
    if (!experiment.flame_slope) crossing.gain = crossing.gain_margin_db = kUnknown;
    result.push_back({.crossing = crossing, .observed_hz = std::nullopt});
  }
  for (const double frequency_hz : observed) {
    const auto distance = [&](const ObservedCrossing& one) {
      return std::abs(one.crossing.frequency_hz - frequency_hz);
    };
    const auto nearest = std::ranges::min_element(result, {}, distance);
    if (nearest == result.end()) continue;
    if (nearest->observed_hz &&
        std::abs(*nearest->observed_hz - nearest->crossing.frequency_hz) < distance(*nearest)) {
      continue;
    }
    nearest->observed_hz = frequency_hz;
    nearest->phase_error_deg = LoopPhaseError(loop, frequency_hz) * kDegPerRad;
    nearest->observed_gain = gain_at(frequency_hz);
  }
  return result;
}

}  // namespace howl
