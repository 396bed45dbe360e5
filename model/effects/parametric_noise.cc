// The flame's gain fluctuates as slow coloured noise (first order): Phi((1 + g(t)) v).
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Fluctuation final : public NamedEffect {
 public:
  Fluctuation()
      : NamedEffect(
            "parametric_noise", LoopBlock::kFlame,
            {{"rel_rms", "", 0.0, 0.0, 2.0, {}}, {"correlation_s", "s", 0.03, 1e-3, 10.0, {}}}) {}
  EffectKind kind() const override { return EffectKind::kGain; }
  bool ChangesFlameCut() const override { return true; }
};

}  // namespace

std::vector<EffectPointer> ParametricNoise() { return {std::make_shared<Fluctuation>()}; }

}  // namespace howl
