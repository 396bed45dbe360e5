// A structure is a model of the rig: the base loop with a set of effects, of noise sources and of
// freedoms of its acoustics, which each operating point has by itself. Its delay is one for all
// operating points, or each point has its own, scattered about one by as much as the records say.
#ifndef HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_H_
#define HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/likelihood/joint_likelihood.h"
#include "model/effects/combined.h"

namespace howl {

struct LoopStructure {
  std::vector<EffectPointer> effects;  // of transfer kind
  std::vector<NoiseTerm> noise;
  bool own_delays = false;
  bool complex_residues = false;  // of the base's modes
  int further_modes = 0;          // beside the base's, with complex residues

  // Which parts of the model the effects' parameters move, one entry a parameter.
  std::vector<Moves> EffectMoves() const {
    std::vector<Moves> out;
    for (const EffectPointer& effect : effects) {
      const Moves moves = {effect->ChangesAcousticCut(), effect->ChangesFlameCut(),
                           effect->ChangesFlameInput() || effect->ModulatesDelay()};
      out.insert(out.end(), effect->parameters().size(), moves);
    }
    return out;
  }

  // All effects combined into one, with the parameters of one effect after those of the other.
  EffectPointer Joined() const {
    EffectPointer joined = effects.empty() ? BaseEffect() : effects[0];
    for (std::size_t i = 1; i < effects.size(); ++i) joined = Combine(joined, effects[i]);
    return joined;
  }
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_H_
