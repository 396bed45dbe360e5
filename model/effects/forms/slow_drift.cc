// The acoustic frequencies drift linearly during a record, by rel_span from its start to its end.
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class MovingFrequency final : public LoopEffect {
 public:
  MovingFrequency(double rel_span, double duration_s)
      : rel_span_(rel_span), duration_s_(duration_s) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<MovingFrequency>(*this);
  }
  void Parameters(const LoopContext& at, LoopParameters<double>* loop,
                  Flame<double>* /*flame*/) override {
    const double middle_s = at.time_s + 0.5 * kLoopBlock * at.step_s;
    const double position = std::clamp(middle_s / duration_s_, 0.0, 1.0) - 0.5;
    loop->acoustics.omega_hz *= 1.0 + rel_span_ * position;
  }

 private:
  double rel_span_;
  double duration_s_;
};

class Drift final : public NamedEffect {
 public:
  Drift()
      : NamedEffect("slow_drift", LoopBlock::kAcoustics,
                    {{"rel_span", "", 0.0, -0.5, 0.5, {-0.01, 0.01}}}) {}
  Separation SeparatedBy() const override { return Separation::kLongRecord; }
  bool ChangesAcousticCut() const override { return true; }
  bool ModulatesAcoustics() const override { return true; }
  void ModulateAcoustics(double position, double /*amplitude*/, EffectValues x,
                         double* omega_factor, double* /*xi_add*/) const override {
    *omega_factor *= 1.0 + x[0] * position;
  }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<MovingFrequency>(x[0], scale.duration_s));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> SlowDrift(const CatalogueBase& /*base*/) {
  return {std::make_shared<Drift>()};
}

}  // namespace howl
