// A placebo effect: one that stands for no physical cause. It puts ripples of fixed, arbitrary
// phase on the transfer functions,
//
//   H(f, phi) = 1 + sum over j of x_j exp(i psi_j(f, phi)),    psi_j: smooth, drawn from a seed
//
// in the cuts that a candidate effect reaches, with as many free parameters as the candidate. psi_j
// turns by more than a wave from one operating point to the next, so that what one experiment tells
// of x_j is of no use for another. A placebo shrinks the held-out gap by what freedom alone takes
// off; the shrinkage by a candidate counts only beyond that.
#ifndef HOWL_DIAGNOSIS_VERDICT_PLACEBO_H_
#define HOWL_DIAGNOSIS_VERDICT_PLACEBO_H_

#include <cstdint>

#include "model/effects/effect.h"

namespace howl {

// parameters: at least one. Not both cuts false.
EffectPointer PlaceboEffect(std::size_t parameters, bool acoustic_cut, bool flame_cut,
                            std::uint64_t seed);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_VERDICT_PLACEBO_H_
