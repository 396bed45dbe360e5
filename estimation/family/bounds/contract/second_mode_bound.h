// Interval forms of what the test asks of the second mode:
//
//   second_mode_share_max     M / (r N) sqrt((xi^2 + y^2) / (xi^2 + y_r^2)) <= maximum   at f
//   second_crossing_gain_min  |N U_1 + M U_r| >= minimum / (w |Phi'(0)|)                 at a line
//
// with y = sinh(ln(f / omega)) and y_r = sinh(ln(f / (r omega))). The contractors lose no member.
// All need a RoundingGuard. Units: Hz, N and M as in model/loop/acoustics.h.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_SECOND_MODE_BOUND_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_SECOND_MODE_BOUND_H_

#include "estimation/family/bounds/contract/contract.h"

namespace howl {

// Holds the share at every point; `relative` is M / N.
Interval SecondModeShareOf(const Interval& omega_hz, const Interval& xi, const Interval& relative,
                           const Interval& harmonic_ratio, const Interval& frequency_hz);

bool ContractSecondModeShare(const ContractTarget& target, ExperimentBox& box);

// The loop's gain at every observed line.
bool ContractLineGain(const ContractTarget& target, ExperimentBox& box);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_SECOND_MODE_BOUND_H_
