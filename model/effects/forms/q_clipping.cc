// Recorded q saturates at a fraction of its amplitude.
#include "model/effects/forms/clipping.h"

namespace howl {

std::vector<EffectPointer> QClipping(const CatalogueBase& /*base*/) {
  return {std::make_shared<Clipping>("q_clipping", LoopBlock::kHeatReleaseInstrument,
                                     Channel::kHeatRelease)};
}

}  // namespace howl
