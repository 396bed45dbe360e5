// The flame's gain fluctuates as slow coloured noise (first order): Phi((1 + g(t)) v).
#include <cmath>
#include <limits>
#include <numbers>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class WanderingGain final : public LoopEffect {
 public:
  WanderingGain(double rel_rms, double correlation_s)
      : rel_rms_(rel_rms), correlation_s_(correlation_s) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<WanderingGain>(*this);
  }
  void Start(const RigParameters& /*rig*/, double step_s, std::uint64_t seed) override {
    const double corner_hz = 1.0 / (kRadPerSPerHz * correlation_s_);
    const double density = 2.0 * rel_rms_ * rel_rms_ / (std::numbers::pi * corner_hz);
    gain_ = ColouredNoise(density, corner_hz, 1.0 / step_s, seed);
  }
  void FlameIn(const LoopContext& /*at*/, std::span<double> v) override {
    for (double& x : v) x *= 1.0 + gain_.Next();
  }

 private:
  double rel_rms_;
  double correlation_s_;
  ColouredNoise gain_{0.0, 1.0, 1.0, 0};
};

class Fluctuation final : public NamedEffect {
 public:
  Fluctuation()
      : NamedEffect(
            "parametric_noise", LoopBlock::kFlame,
            {{"rel_rms", "", 0.0, 0.0, 2.0, {}}, {"correlation_s", "s", 0.03, 1e-3, 10.0, {}}}) {}
  EffectKind kind() const override { return EffectKind::kColouredGain; }
  Separation SeparatedBy() const override { return Separation::kLongRecord; }
  bool ChangesFlameCut() const override { return true; }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<WanderingGain>(x[0], x[1]));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> ParametricNoise(const CatalogueBase& /*base*/) {
  return {std::make_shared<Fluctuation>()};
}

}  // namespace howl
