// The loop that a budget of records has come to, and what an item makes of it (loop_item.h).
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_FORM_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_FORM_H_

#include <vector>

#include "diagnosis/loop_budget/forms/loop_item.h"
#include "diagnosis/loop_budget/forms/shared_effect.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

struct LoopForm {
  PointStructure structure;
  FlameInput flame_input = FlameInput::kPressureRate;
  std::vector<SharedEffect> effects;
  bool fine_noise = false;  // noise_shape
  // Where the rig's records may have a tone (tone.h), of the loop that a search begins with; 0:
  // none is looked for.
  double tone_hz = 0.0;
};

// The least noise that a rig has: combustion's, coloured, and white noise of both sensors.
std::vector<NoiseTerm> LeastNoise();

// The loop that `spec` states with that noise, and without errors at the cycle's lines: a search
// finds what more there is.
LoopForm LeastForm(const RecordLoopSpec& spec);

// The paper's loop as records show it: modes that are tied at `ratio`, with one damping and real
// residues, flame driven by dp/dt; each point's delay is its own.
LoopForm PapersForm(int modes = 2, double ratio = 3.0);

// All that may be added to `model` now, of a search that began at `base`, with effects that a user
// has declared.
std::vector<LoopItem> LoopItems(const LoopForm& model, const LoopForm& base,
                                const std::vector<EffectPointer>& declared = {});

// The shared effects that it has, as items.
std::vector<LoopItem> SharedItemsOf(const LoopForm& model);

// A shared effect comes at its null.
LoopForm With(LoopForm model, const LoopItem& item);
// `model` has the item, which `base` has not.
LoopForm Without(LoopForm model, const LoopItem& item, const LoopForm& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_FORM_H_
