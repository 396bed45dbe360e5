// Another source drives the acoustics at its own frequency; flame and delay answer as always.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Tone final : public NamedEffect {
 public:
  Tone()
      : NamedEffect("external_tone", LoopBlock::kSource,
                    {{"rel", "", 0.0, 0.0, 10.0, {}}, {"hz", "Hz", 100.0, 1.0, 1e5, {}}}) {}
  EffectKind kind() const override { return EffectKind::kLine; }
  bool ChangesAcousticCut() const override { return true; }
};

}  // namespace

std::vector<EffectPointer> ExternalTone() { return {std::make_shared<Tone>()}; }

}  // namespace howl
