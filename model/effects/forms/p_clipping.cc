// Recorded p saturates at a fraction of its amplitude.
#include "model/effects/forms/clipping.h"

namespace howl {

std::vector<EffectPointer> PClipping(const CatalogueBase& /*base*/) {
  return {
      std::make_shared<Clipping>("p_clipping", LoopBlock::kPressureInstrument, Channel::kPressure)};
}

}  // namespace howl
