// p is recorded with few levels.
#include <cmath>

#include "model/effects/catalogue.h"
#include "model/numerics/constants.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

// Simulated with the levels over +-1.2 amplitudes of the cycle, the converter's full scale, one of
// them at zero; beyond it the converter goes on.
constexpr double kFullScale = 1.2;

class Quantiser final : public ChannelInstrument {
 public:
  explicit Quantiser(double step) : ChannelInstrument(Channel::kPressure), step_(step) {}
  std::unique_ptr<Instrument> Clone() const override { return std::make_unique<Quantiser>(*this); }

 protected:
  void ApplyToChannel(double /*time_s*/, std::span<double> signal) override {
    if (step_ == 0.0) return;
    for (double& x : signal) x = step_ * std::nearbyint(x / step_);
  }

 private:
  double step_;
};

class Levels final : public NamedEffect {
 public:
  Levels()
      : NamedEffect("quantisation", LoopBlock::kPressureInstrument,
                    {{"levels", "", kInfinity, 2.0, 1e9, {}}}) {}
  EffectKind kind() const override { return EffectKind::kQuantisation; }
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->digitisers.push_back(
        std::make_shared<Quantiser>(2.0 * kFullScale * scale.pressure_amplitude / x[0]));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> Quantisation(const CatalogueBase& /*base*/) {
  return {std::make_shared<Levels>()};
}

}  // namespace howl
