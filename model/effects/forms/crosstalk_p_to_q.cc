// A share of p leaks into recorded q: rel is the leak's amplitude over that of q, in the mean cycle
// of all experiments (the channels' ranges never change), or in each experiment's own (the ranges
// follow the cycle).
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class Leak final : public Instrument {
 public:
  explicit Leak(double share) : share_(share) {}
  std::unique_ptr<Instrument> Clone() const override { return std::make_unique<Leak>(*this); }
  void Start(double /*rate_hz*/, std::uint64_t /*seed*/) override {}
  void Apply(double /*time_s*/, std::span<double> pressure,
             std::span<double> heat_release) override {
    for (std::size_t i = 0; i < pressure.size(); ++i) heat_release[i] += share_ * pressure[i];
  }

 private:
  double share_;
};

class Crosstalk final : public NamedEffect {
 public:
  explicit Crosstalk(bool own_range)
      : NamedEffect("crosstalk_p_to_q", LoopBlock::kHeatReleaseInstrument,
                    {{"rel", "", 0.0, -3.0, 3.0, {-0.4, -0.2, -0.1, 0.1, 0.2, 0.4}}}),
        own_range_(own_range) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response PressureLeak(double /*frequency_hz*/, const EffectContext& at,
                        EffectValues x) const override {
    return x[0] * HeatReleaseOverPressure(at);
  }
  EffectForm form() const override { return {"range", own_range_ ? "own" : "mean"}; }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->instruments.push_back(std::make_shared<Leak>(x[0] * HeatReleaseOverPressure(scale.at)));
    return true;
  }

 private:
  double HeatReleaseOverPressure(const EffectContext& at) const {
    return own_range_ ? at.own_heat_release_over_pressure : at.heat_release_over_pressure;
  }

  bool own_range_;
};

}  // namespace

std::vector<EffectPointer> CrosstalkPToQ(const CatalogueBase& /*base*/) {
  return {std::make_shared<Crosstalk>(false), std::make_shared<Crosstalk>(true)};
}

}  // namespace howl
