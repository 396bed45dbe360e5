// tau changes linearly with the operating parameter, by rel_span over the range of the experiments.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class Variation final : public NamedEffect {
 public:
  Variation()
      : NamedEffect("delay_varies_with_phi", LoopBlock::kDelay,
                    {{"rel_span", "", 0.0, -0.8, 0.8, {0.0}}}) {}
  bool ChangesFlameCut() const override { return true; }
  double DelayFactor(const EffectContext& at, EffectValues x) const override {
    return 1.0 + x[0] * at.phi_position;
  }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->model.loop.tau_s *= DelayFactor(scale.at, x);
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> DelayVariesWithPhi(const CatalogueBase& /*base*/) {
  return {std::make_shared<Variation>()};
}

}  // namespace howl
