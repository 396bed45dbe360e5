// Heat release follows Phi through a first-order lag, 1 / (1 + s / w_c), inside the loop.
#include <cmath>

#include "model/effects/catalogue.h"
#include "model/numerics/constants.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class FlameLag final : public LoopEffect {
 public:
  explicit FlameLag(double cutoff_hz) : filter_(Channel::kHeatRelease, cutoff_hz) {}
  std::unique_ptr<LoopEffect> Clone() const override { return std::make_unique<FlameLag>(*this); }
  void Start(const RigParameters& /*rig*/, double step_s, std::uint64_t seed) override {
    filter_.Start(1.0 / step_s, seed);
  }
  void FlameOut(const LoopContext& at, std::span<double> heat_release) override {
    filter_.Apply(at.time_s, {}, heat_release);
  }

 private:
  FirstOrderLowPass filter_;
};

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
  Separation SeparatedBy() const override { return Separation::kHighFrequencies; }
  bool ChangesFlameCut() const override { return true; }
  Response FlameOut(double frequency_hz, const EffectContext& /*at*/,
                    EffectValues x) const override {
    return 1.0 / (1.0 + Response(0.0, frequency_hz / x[0]));
  }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<FlameLag>(x[0]));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> FlameLowPass(const CatalogueBase& /*base*/) {
  return {std::make_shared<Lag>()};
}

}  // namespace howl
