// Acoustic damping grows with the square of the slow amplitude: xi + xi_add_at_cycle (a / mean
// a)^2.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Damping final : public NamedEffect {
 public:
  Damping()
      : NamedEffect("nonlinear_damping", LoopBlock::kAcoustics,
                    {{"xi_add_at_cycle", "", 0.0, -0.5, 1.0, {0.0, 0.05}}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ModulatesAcoustics() const override { return true; }
  void ModulateAcoustics(double /*position*/, double amplitude, EffectValues x,
                         double* /*omega_factor*/, double* xi_add) const override {
    *xi_add += x[0] * amplitude * amplitude;
  }
};

}  // namespace

std::vector<EffectPointer> NonlinearDamping() { return {std::make_shared<Damping>()}; }

}  // namespace howl
