// What is tried as one candidate: an effect, or the forms that it may have (orders of a filter,
// say).
#ifndef HOWL_DIAGNOSIS_CANDIDATES_EFFECT_FORMS_H_
#define HOWL_DIAGNOSIS_CANDIDATES_EFFECT_FORMS_H_

#include <vector>

#include "model/effects/effect.h"

namespace howl {

// One for each identifier of the catalogue: its forms.
using EffectForms = std::vector<EffectPointer>;

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CANDIDATES_EFFECT_FORMS_H_
