// The relations between an experiment's variables at the limit cycle and at its lines, in the mean
// value form
// (estimation/family/bounds/contract/centred_response.h):
//
//   0 = Im N,   N = Re N,   |G(f_l)| >= second_crossing_gain_min / (w_l |Phi'(0)|),
//   arg G(f_l) - w_l tau = pi / 2 + error + 2 pi k,   w tau = turns + theta - loop phase error.
//
// The first equation takes omega, M or xi out of each of the others to first order, so that what is
// known only together does not count as uncertain twice.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_BOUND_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_BOUND_H_

#include "estimation/family/bounds/contract/contract.h"

namespace howl {

// Two modes. Narrows nothing where a variable has no end, nor without a line where a transfer is
// asked for, of which ContractSlabs does as much. Needs a RoundingGuard.
bool ContractCentred(const ContractTarget& target, ExperimentBox& box);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_BOUND_H_
