// Acoustic damping grows with the square of the slow amplitude a, which follows p with a memory:
//
//   xi + xi_add_at_cycle a^2 / mean a^2
#include <string>

#include "model/effects/catalogue.h"
#include "model/effects/forms/lagged_amplitude.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class GrowingDamping final : public LoopEffect {
 public:
  GrowingDamping(double xi_add, double mean_amplitude, const AmplitudeSense& sense)
      : xi_add_(xi_add), mean_amplitude_(mean_amplitude), amplitude_(sense) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<GrowingDamping>(*this);
  }
  void Parameters(const LoopContext& at, LoopParameters<double>* loop,
                  Flame<double>* /*flame*/) override {
    const double relative =
        amplitude_.Next(at.pressure_square, kLoopBlock * at.step_s) / mean_amplitude_;
    loop->acoustics.xi += xi_add_ * relative * relative;
  }

 private:
  double xi_add_;
  double mean_amplitude_;
  LaggedAmplitude amplitude_;
};

class Damping final : public NamedEffect {
 public:
  Damping(int lags, bool over_own)
      : NamedEffect("nonlinear_damping", LoopBlock::kAcoustics,
                    {{"xi_add_at_cycle", "", 0.0, -0.5, 1.0, {0.02}},
                     {"memory_s", "s", 0.02, 1e-3, 0.3, {0.015}, ParameterScale::kLogarithmic}}),
        lags_(lags),
        over_own_(over_own) {}
  Separation SeparatedBy() const override { return Separation::kCycleAmplitude; }
  bool ChangesAcousticCut() const override { return true; }
  bool ModulatesAcoustics() const override { return true; }
  void ModulateAcoustics(double /*position*/, double amplitude, EffectValues x,
                         double* /*omega_factor*/, double* xi_add) const override {
    *xi_add += x[0] * amplitude * amplitude;
  }
  std::optional<AmplitudeSense> AcousticSense(EffectValues x) const override {
    return AmplitudeSense{x[1], lags_, false, over_own_};
  }
  EffectForm form() const override {
    return {"amplitude", std::string(over_own_ ? "over_own" : "over_mean") +
                             (lags_ == 1 ? "_one_lag" : "_two_lags")};
  }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<GrowingDamping>(
        x[0], over_own_ ? scale.pressure_amplitude : scale.mean_pressure_amplitude,
        *AcousticSense(x)));
    return true;
  }

 private:
  int lags_;
  bool over_own_;
};

}  // namespace

std::vector<EffectPointer> NonlinearDamping(const CatalogueBase& /*base*/) {
  std::vector<EffectPointer> forms;
  for (const bool over_own : {false, true}) {
    for (const int lags : {1, 2}) forms.push_back(std::make_shared<Damping>(lags, over_own));
  }
  return forms;
}

}  // namespace howl
