// An effect that means nothing: ripples of fixed, arbitrary phase on the transfer functions,
//
//   H(f, phi) = 1 + sum over j of x_j exp(i psi_j(f, phi)),    psi_j: smooth, drawn from a seed
//
// in the cuts that another effect reaches, with as many free parameters. From one operating point
// to the next psi_j turns by more than a wave: what an experiment tells of x_j is of no use for
// another. What it takes off the held-out gap is what freedom alone takes off: the shrinkage by an
// effect counts only beyond it.
#ifndef HOWL_DIAGNOSIS_NO_MEANING_H_
#define HOWL_DIAGNOSIS_NO_MEANING_H_

#include <cstdint>

#include "model/effects/catalogue.h"
#include "model/effects/effect.h"

namespace howl {

// parameters: at least one. Not both cuts false.
EffectPointer NoMeaning(std::size_t parameters, bool acoustic_cut, bool flame_cut,
                        std::uint64_t seed);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NO_MEANING_H_
