// The flame's gain drops by a share and recovers at random times.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Dropout final : public NamedEffect {
 public:
  Dropout()
      : NamedEffect("intermittency", LoopBlock::kFlame,
                    {{"gain_drop", "", 0.0, 0.0, 1.0, {}}, {"dwell_s", "s", 0.2, 1e-2, 10.0, {}}}) {
  }
  EffectKind kind() const override { return EffectKind::kGain; }
  bool ChangesFlameCut() const override { return true; }
};

}  // namespace

std::vector<EffectPointer> Intermittency() { return {std::make_shared<Dropout>()}; }

}  // namespace howl
