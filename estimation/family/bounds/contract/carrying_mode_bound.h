// Bounds of the first mode by (5b). With the second mode's share s = |M U_r| / |N U_1| < 1 at the
// cycle, G = N U_1 (1 + z) with |z| <= s, so that N U_1 is nearly G itself,
//
//   |G| / (1 + s) <= |N U_1| <= |G| / (1 - s),     |arg(N U_1) - arg G| <= asin s
//   M <= s / (1 - s) |G| / |U_r|
//
// and the relations of one mode (ContractPhase, ContractGain) hold with tolerances wider by s. They
// bound omega, N and M where xi may vanish, which no relation between the two modes does. Loses no
// member. Needs a RoundingGuard.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CARRYING_MODE_BOUND_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CARRYING_MODE_BOUND_H_

#include "estimation/family/bounds/contract/contract.h"

namespace howl {

bool ContractCarryingMode(const ContractTarget& target, ExperimentBox& box);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CARRYING_MODE_BOUND_H_
