// Another source drives the acoustics at its own frequency; flame and delay answer as always.
#include <cmath>
#include <limits>
#include <numbers>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class Source final : public LoopEffect {
 public:
  Source(double amplitude, double hz) : amplitude_(amplitude), hz_(hz) {}
  std::unique_ptr<LoopEffect> Clone() const override { return std::make_unique<Source>(*this); }
  void Start(const RigParameters& /*rig*/, double /*step_s*/, std::uint64_t seed) override {
    phase_rad_ = 2.0 * std::numbers::pi * RandomStream(seed).Uniform();
  }
  bool Drives() const override { return true; }
  void Drive(const LoopContext& at, std::span<double> drive) override {
    for (std::size_t i = 0; i < drive.size(); ++i) {
      const double t = at.time_s + static_cast<double>(i) * at.step_s;
      drive[i] += amplitude_ * std::cos(kRadPerSPerHz * hz_ * t + phase_rad_);
    }
  }

 private:
  double amplitude_;
  double hz_;
  double phase_rad_ = 0.0;
};

class Tone final : public NamedEffect {
 public:
  Tone()
      : NamedEffect("external_tone", LoopBlock::kSource,
                    {{"rel", "", 0.0, 0.0, 10.0, {}}, {"hz", "Hz", 100.0, 1.0, 1e5, {}}}) {}
  EffectKind kind() const override { return EffectKind::kTone; }
  bool ChangesAcousticCut() const override { return true; }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<Source>(x[0] * scale.heat_release_amplitude, x[1]));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> ExternalTone(const CatalogueBase& /*base*/) {
  return {std::make_shared<Tone>()};
}

}  // namespace howl
