// A share of p leaks into recorded q. rel is the leak at the fundamental over the recorded q there,
// both signals being scaled to the mean cycle of all experiments.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulate.h"

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
  Crosstalk()
      : NamedEffect("crosstalk_p_to_q", LoopBlock::kHeatReleaseInstrument,
                    {{"rel", "", 0.0, -3.0, 3.0, {-0.4, -0.2, -0.1, 0.1, 0.2, 0.4}}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response PressureLeak(double /*frequency_hz*/, const EffectContext& at,
                        EffectValues x) const override {
    return x[0] * at.heat_release_over_pressure;
  }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->instruments.push_back(std::make_shared<Leak>(x[0] * scale.at.heat_release_over_pressure));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> CrosstalkPToQ() { return {std::make_shared<Crosstalk>()}; }

}  // namespace howl
