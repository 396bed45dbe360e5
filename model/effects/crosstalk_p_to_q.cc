// A share of p leaks into recorded q. rel is the leak at the fundamental over the recorded q there,
// both signals being scaled to the mean cycle of all experiments.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Crosstalk final : public NamedEffect {
 public:
  Crosstalk()
      : NamedEffect("crosstalk_p_to_q", LoopBlock::kHeatReleaseInstrument,
                    {{"rel", "", 0.0, -3.0, 3.0, {-0.4, -0.2, -0.1, 0.1, 0.2, 0.4}}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response PressureLeak(double /*frequency_hz*/, const EffectContext& at,
                        EffectValues x) const override {
    return x[0] * at.heat_release_over_pressure;
  }
};

}  // namespace

std::vector<EffectPointer> CrosstalkPToQ() { return {std::make_shared<Crosstalk>()}; }

}  // namespace howl
