// Acoustics whose frequencies or damping move slowly (Effect::ModulateAcoustics), driven by q.
//
// Frequencies drift over the whole record: the quasi-static expansion about the mean, to second
// order in d(t) = log omega(t) less its mean,
//
//   p(t) = [R q] + d(t) [R' q] + d(t)^2 / 2 [R'' q].
//
// Damping follows the amplitude, which changes within the memory of a mode, 1 / (omega xi): no
// expansion of this kind holds. Each mode's own equation does,
//
//   p'' + 2 xi omega p' + omega^2 p = c q' - 2 omega (xi(t) - xi) p',
//
// solved by putting the last p on the right-hand side; every pass gains a factor of the damping's
// relative change.
//
// The experiment's parameters are those of the mean over the record: what an effect adds in the
// mean is theirs, and the fit need not follow it.
#ifndef HOWL_DIAGNOSIS_CUTS_ACOUSTIC_MODULATION_H_
#define HOWL_DIAGNOSIS_CUTS_ACOUSTIC_MODULATION_H_

#include <Eigen/Core>

#include "diagnosis/cuts/acoustic_locals.h"
#include "diagnosis/records/cut_record.h"

namespace howl {

// What the movement about the means adds to p, on the extended band; empty where nothing moves.
Eigen::VectorXcd PressureOfMovement(const CutRecord& record, const Effect& effect, EffectValues x,
                                    const AcousticLocals& mean);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CUTS_ACOUSTIC_MODULATION_H_
