// Two effects of transfer kind at once: their factors multiply, their shifts add.
//
//   G = G_1 + G_2 - G_0;   instruments, FlameIn, FlameOut, DelayFactor: products;   leaks,
//   DelayPerAmplitude, added damping: sums
//
// Parameters are the first's, then the second's, each named "effect.parameter".
#ifndef HOWL_MODEL_EFFECTS_COMBINED_H_
#define HOWL_MODEL_EFFECTS_COMBINED_H_

#include <string>
#include <string_view>

#include "model/effects/catalogue.h"

namespace howl {

// "first+second".
std::string CombinedId(std::string_view first, std::string_view second);

// The block is the first's. Both must be of kind kTransfer.
EffectPointer Combine(const EffectPointer& first, const EffectPointer& second);

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_COMBINED_H_
