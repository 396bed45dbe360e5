#include "estimation/family/bounds/contract/carrying_mode_bound.h"

#include <cmath>

namespace howl {

bool ContractCarryingMode(const ContractTarget& target, ExperimentBox& box) {
  const double share = target.second_mode_share_max;
  if (!(share < 1.0)) return true;
  const Interval s(0.0, share);
  // The first mode alone, as ContractPhase and ContractGain know it.
  ExperimentBox first = box;
  first[kCellGain] = box[kCellGain] / (1.0 + Interval(-share, share));
  // asin s = atan(s / sqrt(1 - s^2)); tan(a + b) of tan a and tan b, where a + b stays within a
  // right angle.
  const double across = (Interval(share) / sqrt(1.0 - square(Interval(share)))).upper();
  const Interval turned = Arctangent(box[kCellTangent]) + Arctangent(Interval(-across, across));
  constexpr double kRightAngle = 1.5707963267948965;  // rounded down
  if (turned.lower() > -kRightAngle && turned.upper() < kRightAngle) {
    first[kCellTangent] = Tangent(turned);
    if (!ContractPhase(target, first) || !ContractGain(target, first)) return false;
  }
  for (const CellVariable variable : {kCellOmega, kCellXi, kCellN}) {
    if (!Narrow(box[variable], first[variable])) return false;
  }
  const Interval omega_r =
      target.w_rad_s / target.frequency_hz * target.harmonic_ratio * box[kCellOmega];
  const Interval inverse_size = sqrt(square(2.0 * omega_r * box[kCellXi]) +
                                     square(target.w_rad_s - square(omega_r) / target.w_rad_s));
  const double most = (s / (1.0 - Interval(share)) * box[kCellGain] * inverse_size).upper();
  return !std::isfinite(most) || NarrowUpper(box[kCellM], most);
}

}  // namespace howl
