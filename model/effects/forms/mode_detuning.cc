// The upper mode is not where the base has it, at three times the first or at the config's ratio.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

// Of the base's ratio: the bounds, and the starts on either side.
constexpr double kLeast = 1.3 / 3.0;
constexpr double kMost = 2.0;
constexpr double kBelow = 2.6 / 3.0;
constexpr double kAbove = 3.4 / 3.0;

class Detuning final : public NamedEffect {
 public:
  explicit Detuning(double harmonic_ratio)
      : NamedEffect("mode_detuning", LoopBlock::kAcoustics,
                    {{"ratio",
                      "",
                      harmonic_ratio,
                      kLeast * harmonic_ratio,
                      kMost * harmonic_ratio,
                      {kBelow * harmonic_ratio, kAbove * harmonic_ratio},
                      ParameterScale::kLogarithmic}}) {}
  bool ChangesAcousticCut() const override { return true; }
  Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                     const EffectContext& at, EffectValues x) const override {
    howl::Acoustics<double> moved = acoustics;
    moved.harmonic_ratio = x[0];
    return Effect::Acoustics(moved, frequency_hz, at, x);
  }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->model.loop.acoustics.harmonic_ratio = x[0];
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> ModeDetuning(const CatalogueBase& base) {
  if (base.modes == 1) return {};
  return {std::make_shared<Detuning>(base.harmonic_ratio)};
}

}  // namespace howl
