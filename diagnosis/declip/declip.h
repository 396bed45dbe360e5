// Declipping. Samples of p that saturation cut off are missing data, and cut A predicts them:
//
//   p(t) = p_model(t) on the plateaus where it lies beyond their level;   P_model = R Q
//
// First R is fitted to the unclipped samples alone (unclipped_samples.h); then, by expectation and
// maximisation (EM), to the whole signal with its plateaus filled in, at the spectrum of its noise.
//
// What is filled in agrees with the model by construction. An effect that is not in the model
// therefore shows in the unclipped samples only, and less than it would without saturation.
#ifndef HOWL_DIAGNOSIS_DECLIP_DECLIP_H_
#define HOWL_DIAGNOSIS_DECLIP_DECLIP_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct Declipped {
  std::vector<Eigen::VectorXd> pressure;  // of each experiment, without mean
  EffectFit fit;  // its values and its acoustics are those of the plateaus; the rest as given
};

// `filled`: the same records with their plateaus filled in before, or as recorded too.
//
// threads: 0 for as many as there are.
//
// Acoustics and the effect's values are fitted to the unclipped samples: from several starts where
// there are no values, else from those given.
Declipped DeclipAnew(const std::vector<CutRecord>& recorded, const std::vector<CutRecord>& filled,
                     EffectFit fit, int threads);

// The same at the effect's values as given, with the given acoustics as the start.
Declipped DeclipAt(const std::vector<CutRecord>& recorded, const std::vector<CutRecord>& filled,
                   EffectFit fit, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_DECLIP_DECLIP_H_
