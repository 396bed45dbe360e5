#include "estimation/analysis/loop/loop_gain_reason.h"

#include <cmath>
#include <complex>

#include "model/numerics/units.h"

namespace howl {

std::string_view LoopGainReasonName(LoopGainReason reason) {
  switch (reason) {
    case LoopGainReason::kSteeperInCycle:
      return "steeper_in_cycle";
    case LoopGainReason::kMemory:
      return "memory";
    case LoopGainReason::kNoise:
      return "noise";
    case LoopGainReason::kNotExplained:
      break;
  }
  return "not_seen";
}

std::optional<LowLoopGain> ExplainLowLoopGain(const Characteristics& cycle, const FlameCurve& curve,
                                              const Estimate& loop_gain) {
  constexpr double kShare = 0.5;
  if (cycle.state != CycleState::kLimitCycle || !std::isfinite(loop_gain.value) ||
      !(loop_gain.value + kNormal95 * loop_gain.std < 1.0) ||
      curve.mean_cycle.size() < kMeanCycleHarmonics) {
    return std::nullopt;
  }
  const std::complex<double> third = curve.mean_cycle[2];
  const double fifth = curve.mean_cycle[4].real();
  LowLoopGain low;
  low.third_harmonic = third.real();
  low.turn_deg = std::arg(third) * kDegPerRad;
  low.shape_gain = 1.0 - 3.0 * third.real() + 5.0 * fifth;
  low.stiffening = 6.0 * third.real() + 10.0 * fifth;
  low.regressor_noise = curve.regressor_noise;
  const double missing = 1.0 - loop_gain.value;
  if (3.0 * std::abs(third) >= kShare * missing &&
      std::abs(third.imag()) > std::abs(third.real())) {
    low.reason = LoopGainReason::kMemory;
  } else if (1.0 - low.shape_gain >= kShare * missing && low.stiffening > 0.0) {
    low.reason = LoopGainReason::kSteeperInCycle;
  } else if (curve.regressor_noise >= kShare * missing) {
    low.reason = LoopGainReason::kNoise;
  }
  return low;
}

}  // namespace howl
