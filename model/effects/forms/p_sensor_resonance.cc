// Recorded p is true p through a second-order resonance, the line or the cavity of a transducer:
// 1 / (1 + 2 zeta s / w_0 + (s / w_0)^2).
#include <cmath>

#include "model/effects/catalogue.h"
#include "model/numerics/constants.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class Resonance final : public NamedEffect {
 public:
  Resonance()
      : NamedEffect("p_sensor_resonance", LoopBlock::kPressureInstrument,
                    {{"f0_hz",
                      "Hz",
                      kInfinity,
                      120.0,
                      2e4,
                      {450.0, 700.0, 1000.0, 1600.0, 3000.0},
                      ParameterScale::kLogarithmic},
                     {"zeta", "", 0.2, 0.01, 2.0, {0.15}, ParameterScale::kLogarithmic}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  bool ChangesFlameInput() const override { return true; }
  Response PressureInstrument(double frequency_hz, EffectValues x) const override {
    const Response s(0.0, frequency_hz / x[0]);
    return 1.0 / (1.0 + 2.0 * x[1] * s + s * s);
  }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->instruments.push_back(
        std::make_shared<SecondOrderResponse>(Channel::kPressure, x[0], x[1]));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> PSensorResonance(const CatalogueBase& /*base*/) {
  return {std::make_shared<Resonance>()};
}

}  // namespace howl
