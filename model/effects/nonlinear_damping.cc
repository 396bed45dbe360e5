// Acoustic damping grows with the square of the slow amplitude: xi + xi_add_at_cycle (a / mean
// a)^2.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulate.h"

namespace howl {
namespace {

class GrowingDamping final : public LoopEffect {
 public:
  GrowingDamping(double xi_add, double mean_amplitude)
      : xi_add_(xi_add), mean_amplitude_(mean_amplitude) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<GrowingDamping>(*this);
  }
  void Parameters(const LoopContext& at, LoopParameters<double>* loop,
                  Flame<double>* /*flame*/) override {
    const double relative = at.pressure_amplitude / mean_amplitude_;
    loop->acoustics.xi += xi_add_ * relative * relative;
  }

 private:
  double xi_add_;
  double mean_amplitude_;
};

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
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<GrowingDamping>(x[0], scale.mean_pressure_amplitude));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> NonlinearDamping() { return {std::make_shared<Damping>()}; }

}  // namespace howl
