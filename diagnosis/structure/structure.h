// A structure is a model of the rig: the base loop with a set of effects and of noise sources. Its
// delay is one for all operating points, or each point has its own, scattered about one by as much
// as the records say.
#ifndef HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_H_
#define HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_H_

#include <vector>

#include "diagnosis/effect_fit.h"
#include "diagnosis/likelihood/noise_sources.h"
#include "model/effects/combined.h"

namespace howl {

struct LoopStructure {
  std::vector<EffectPointer> effects;  // of transfer kind
  std::vector<NoiseTerm> noise;
  bool own_delays = false;

  // All effects combined into one, with the parameters of one effect after those of the other.
  EffectPointer Joined() const {
    EffectPointer joined = effects.empty() ? BaseEffect() : effects[0];
    for (std::size_t i = 1; i < effects.size(); ++i) joined = Combine(joined, effects[i]);
    return joined;
  }
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_H_
