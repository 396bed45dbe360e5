// The upper mode is not at three times the first.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulate.h"

namespace howl {
namespace {

class Detuning final : public NamedEffect {
 public:
  Detuning()
      : NamedEffect("mode_detuning", LoopBlock::kAcoustics,
                    {{"ratio",
                      "",
                      kSeedHarmonicRatio,
                      1.3,
                      6.0,
                      {2.6, 3.4},
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

std::vector<EffectPointer> ModeDetuning() { return {std::make_shared<Detuning>()}; }

}  // namespace howl
