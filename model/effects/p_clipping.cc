// Recorded p saturates at a fraction of its amplitude.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulate.h"

namespace howl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Clipping final : public NamedEffect {
 public:
  Clipping()
      : NamedEffect("p_clipping", LoopBlock::kPressureInstrument,
                    {{"fraction", "", kInfinity, 0.2, 2.0, {}}}) {}
  EffectKind kind() const override { return EffectKind::kClipping; }
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->digitisers.push_back(
        std::make_shared<ClippingInstrument>(Channel::kPressure, x[0] * scale.pressure_amplitude));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> PClipping() { return {std::make_shared<Clipping>()}; }

}  // namespace howl
