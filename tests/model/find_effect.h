// An effect of a catalogue by its name, for tests.
#ifndef HOWL_TESTS_MODEL_FIND_EFFECT_H_
#define HOWL_TESTS_MODEL_FIND_EFFECT_H_

#include <cstddef>
#include <string_view>
#include <vector>

#include "model/effects/effect.h"

namespace howl {

// The form-th of that name; null if there is none.
inline EffectPointer FindIn(const std::vector<EffectPointer>& catalogue, std::string_view id,
                            std::size_t form = 0) {
  for (const EffectPointer& effect : catalogue) {
    if (effect->id() == id && form-- == 0) return effect;
  }
  return nullptr;
}

}  // namespace howl

#endif  // HOWL_TESTS_MODEL_FIND_EFFECT_H_
