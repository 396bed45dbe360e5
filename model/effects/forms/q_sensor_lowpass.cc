// Recorded q is true q through a low-pass of first order, 1 / (1 + s / w_c), or of second order
// (Butterworth), 1 / (1 + sqrt(2) s / w_c + (s / w_c)^2).
#include <cmath>

#include "model/effects/catalogue.h"
#include "model/numerics/constants.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

// Of cycles of 210 Hz the lowest start is 0.4: from 1.2 alone a filter at 0.35 was not found
// (tests/diagnosis/loop_budget/shared_effect_test.cc).
class Filter final : public NamedEffect {
 public:
  explicit Filter(int order)
      : NamedEffect("q_sensor_lowpass", LoopBlock::kHeatReleaseInstrument,
                    {{"cutoff_hz",
                      "Hz",
                      kInfinity,
                      60.0,
                      1e6,
                      {85.0, 250.0, 700.0, 2000.0},
                      ParameterScale::kLogarithmic}}),
        order_(order) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override {
    const Response s(0.0, frequency_hz / x[0]);
    return order_ == 1 ? 1.0 / (1.0 + s) : 1.0 / (1.0 + std::sqrt(2.0) * s + s * s);
  }
  EffectForm form() const override { return {"order", std::to_string(order_)}; }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    if (order_ == 1) {
      rig->instruments.push_back(std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, x[0]));
    } else {
      rig->instruments.push_back(
          std::make_shared<SecondOrderResponse>(Channel::kHeatRelease, x[0], std::sqrt(0.5)));
    }
    return true;
  }

 private:
  int order_;
};

}  // namespace

std::vector<EffectPointer> QSensorLowPass(const CatalogueBase& /*base*/) {
  return {std::make_shared<Filter>(1), std::make_shared<Filter>(2)};
}

}  // namespace howl
