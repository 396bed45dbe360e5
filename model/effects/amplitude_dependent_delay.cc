// tau changes in proportion to the slow amplitude of the cycle; rel_at_cycle at the mean amplitude
// of all experiments.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Dependence final : public NamedEffect {
 public:
  Dependence()
      : NamedEffect("amplitude_dependent_delay", LoopBlock::kDelay,
                    {{"rel_at_cycle", "", 0.0, -0.6, 0.6, {0.01}}}) {}
  bool ChangesFlameCut() const override { return true; }
  bool ModulatesDelay() const override { return true; }
  double DelayFactor(const EffectContext& at, EffectValues x) const override {
    return 1.0 + x[0] * at.relative_amplitude;
  }
  double DelayPerAmplitude(EffectValues x) const override { return x[0]; }
};

}  // namespace

std::vector<EffectPointer> AmplitudeDependentDelay() { return {std::make_shared<Dependence>()}; }

}  // namespace howl
