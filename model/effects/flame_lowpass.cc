// Heat release follows Phi through a first-order lag, 1 / (1 + s / w_c), inside the loop.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Lag final : public NamedEffect {
 public:
  Lag()
      : NamedEffect("flame_lowpass", LoopBlock::kFlame,
                    {{"cutoff_hz",
                      "Hz",
                      kInfinity,
                      60.0,
                      1e6,
                      {250.0, 700.0, 2000.0},
                      ParameterScale::kLogarithmic}}) {}
  bool ChangesFlameCut() const override { return true; }
  Response FlameOut(double frequency_hz, EffectValues x) const override {
    return 1.0 / (1.0 + Response(0.0, frequency_hz / x[0]));
  }
};

}  // namespace

std::vector<EffectPointer> FlameLowPass() { return {std::make_shared<Lag>()}; }

}  // namespace howl
