// Declipping. Samples of p that saturation cut off are missing data, and cut A says what they were:
//
//   p(t) = p_model(t) on the plateaus where it lies beyond their level;   P_model = R Q
//
// First R is fitted to the samples beside the plateaus alone (beside_plateaus.h); then, by
// expectation and maximisation, to the whole signal filled in, at the spectrum of its noise.
//
// What is filled in agrees with the model by construction. So an effect that is not in the model
// shows in the samples that were recorded, and less than it would without saturation.
#ifndef HOWL_DIAGNOSIS_DECLIP_DECLIP_H_
#define HOWL_DIAGNOSIS_DECLIP_DECLIP_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/effect_fit.h"

namespace howl {

struct Declipped {
  std::vector<Eigen::VectorXd> pressure;  // of each experiment, without mean
  EffectFit fit;  // its values and its acoustics are those of the plateaus; the rest as given
};

// `filled`: the same records with their plateaus filled in before, or as recorded too.
//
// threads: 0 for as many as there are.
//
// Acoustics and the effect's values are fitted beside the plateaus: from several starts where there
// are no values, else from those given.
Declipped DeclipAnew(const std::vector<CutRecord>& recorded, const std::vector<CutRecord>& filled,
                     EffectFit fit, int threads);

// At the effect's values as given, from its acoustics on.
Declipped DeclipAt(const std::vector<CutRecord>& recorded, const std::vector<CutRecord>& filled,
                   EffectFit fit, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_DECLIP_DECLIP_H_
