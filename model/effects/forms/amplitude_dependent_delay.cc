// tau changes in proportion to the slow amplitude of the cycle, that of p or of what drives the
// flame, p'; rel_at_cycle at the mean amplitude of all experiments. Cycles of unlike frequency tell
// the two apart.
#include <algorithm>

#include "model/effects/catalogue.h"
#include "model/effects/forms/lagged_amplitude.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

constexpr double kLeastFactor = 0.4;
constexpr double kMostFactor = 2.5;

class MovingDelay final : public LoopEffect {
 public:
  MovingDelay(double rel_at_cycle, double mean_amplitude, const AmplitudeSense& sense)
      : rel_at_cycle_(rel_at_cycle),
        mean_amplitude_(mean_amplitude),
        of_rate_(sense.of_rate),
        amplitude_(sense) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<MovingDelay>(*this);
  }
  bool MovesDelay() const override { return true; }
  void Delay(const LoopContext& at, std::span<double> tau_s) override {
    // The amplitude is that of the block; between blocks the delay goes on without a jump.
    const double amplitude = amplitude_.Next(of_rate_ ? at.rate_square : at.pressure_square,
                                             static_cast<double>(tau_s.size()) * at.step_s);
    const double now =
        std::clamp(1.0 + rel_at_cycle_ * amplitude / mean_amplitude_, kLeastFactor, kMostFactor);
    const double from = started_ ? factor_ : now;
    const double step = (now - from) / static_cast<double>(tau_s.size());
    for (std::size_t i = 0; i < tau_s.size(); ++i) {
      tau_s[i] *= from + step * static_cast<double>(i + 1);
    }
    factor_ = now;
    started_ = true;
  }
  double ShortestDelay(double tau_s) const override {
    return rel_at_cycle_ < 0.0 ? kLeastFactor * tau_s : tau_s;
  }

 private:
  double rel_at_cycle_;
  double mean_amplitude_;
  bool of_rate_;
  LaggedAmplitude amplitude_;
  double factor_ = 1.0;
  bool started_ = false;
};

class Dependence final : public NamedEffect {
 public:
  explicit Dependence(bool of_rate)
      : NamedEffect("amplitude_dependent_delay", LoopBlock::kDelay,
                    {{"rel_at_cycle", "", 0.0, -0.6, 0.6, {0.01}},
                     {"memory_s", "s", 0.02, 1e-3, 0.3, {0.02}, ParameterScale::kLogarithmic}}),
        of_rate_(of_rate) {}
  Separation SeparatedBy() const override { return Separation::kCycleAmplitude; }
  bool ChangesFlameCut() const override { return true; }
  bool ModulatesDelay() const override { return true; }
  double DelayFactor(const EffectContext& at, EffectValues x) const override {
    return 1.0 + x[0] * (of_rate_ ? at.relative_rate_amplitude : at.relative_amplitude);
  }
  double DelayPerAmplitude(EffectValues x) const override { return x[0]; }
  std::optional<AmplitudeSense> DelaySense(EffectValues x) const override {
    return AmplitudeSense{x[1], 1, of_rate_};
  }
  EffectForm form() const override { return {"amplitude_of", of_rate_ ? "rate" : "pressure"}; }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<MovingDelay>(
        x[0], of_rate_ ? scale.mean_rate_amplitude : scale.mean_pressure_amplitude,
        *DelaySense(x)));
    return true;
  }

 private:
  bool of_rate_;
};

}  // namespace

std::vector<EffectPointer> AmplitudeDependentDelay(const CatalogueBase& /*base*/) {
  return {std::make_shared<Dependence>(false), std::make_shared<Dependence>(true)};
}

}  // namespace howl
