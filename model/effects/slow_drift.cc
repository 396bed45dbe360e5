// The acoustic frequencies drift linearly during a record, by rel_span from its start to its end.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Drift final : public NamedEffect {
 public:
  Drift()
      : NamedEffect("slow_drift", LoopBlock::kAcoustics,
                    {{"rel_span", "", 0.0, -0.5, 0.5, {-0.01, 0.01}}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ModulatesAcoustics() const override { return true; }
  void ModulateAcoustics(double position, double /*amplitude*/, EffectValues x,
                         double* omega_factor, double* /*xi_add*/) const override {
    *omega_factor *= 1.0 + x[0] * position;
  }
};

}  // namespace

std::vector<EffectPointer> SlowDrift() { return {std::make_shared<Drift>()}; }

}  // namespace howl
