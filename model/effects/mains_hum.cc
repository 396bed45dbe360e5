// 50 or 60 Hz and its multiples in one recorded channel.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Hum final : public NamedEffect {
 public:
  Hum()
      : NamedEffect("mains_hum", LoopBlock::kHeatReleaseInstrument,
                    {{"rel", "", 0.0, 0.0, 10.0, {}}, {"hz", "Hz", 50.0, 50.0, 60.0, {}}}) {}
  EffectKind kind() const override { return EffectKind::kLine; }
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
};

}  // namespace

std::vector<EffectPointer> MainsHum() { return {std::make_shared<Hum>()}; }

}  // namespace howl
