// The acoustics of one experiment: what a fit varies of G, the modes of the base (the paper,
// section 3.3).
#ifndef HOWL_DIAGNOSIS_CUTS_ACOUSTIC_LOCALS_H_
#define HOWL_DIAGNOSIS_CUTS_ACOUSTIC_LOCALS_H_

#include <Eigen/Core>

#include "diagnosis/records/base_model.h"
#include "model/loop/acoustics.h"

namespace howl {

// One experiment's own parameters in cut A: log omega (Hz), log xi, N, M. With one mode M is zero.
using AcousticLocals = Eigen::Vector4d;

// Whether the local of this number is free in the model.
inline bool IsFree(const BaseModel& model, Eigen::Index local) {
  return local < 3 || model.modes > 1;
}

Acoustics<double> ToAcoustics(const BaseModel& model, const AcousticLocals& locals);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CUTS_ACOUSTIC_LOCALS_H_
