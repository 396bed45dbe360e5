// A recorded signal saturates at a fraction of its amplitude: the same effect in either channel.
#ifndef HOWL_MODEL_EFFECTS_FORMS_CLIPPING_H_
#define HOWL_MODEL_EFFECTS_FORMS_CLIPPING_H_

#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {

class Clipping final : public NamedEffect {
 public:
  Clipping(std::string id, LoopBlock block, Channel channel)
      : NamedEffect(std::move(id), block,
                    {{"fraction", "", std::numeric_limits<double>::infinity(), 0.2, 2.0, {}}}),
        channel_(channel) {}
  EffectKind kind() const override { return EffectKind::kClipping; }
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    const double amplitude =
        channel_ == Channel::kPressure ? scale.pressure_amplitude : scale.heat_release_amplitude;
    rig->digitisers.push_back(std::make_shared<ClippingInstrument>(channel_, x[0] * amplitude));
    return true;
  }

 private:
  Channel channel_;
};

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_FORMS_CLIPPING_H_
