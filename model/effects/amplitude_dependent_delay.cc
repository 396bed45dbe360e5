// tau changes in proportion to the slow amplitude of the cycle; rel_at_cycle at the mean amplitude
// of all experiments.
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulate.h"

namespace howl {
namespace {

constexpr double kLeastFactor = 0.4;
constexpr double kMostFactor = 2.5;

class MovingDelay final : public LoopEffect {
 public:
  MovingDelay(double rel_at_cycle, double mean_amplitude)
      : rel_at_cycle_(rel_at_cycle), mean_amplitude_(mean_amplitude) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<MovingDelay>(*this);
  }
  bool MovesDelay() const override { return true; }
  void Delay(const LoopContext& at, std::span<double> tau_s) override {
    // The amplitude is that of the block; between blocks the delay goes on without a jump.
    const double now = std::clamp(1.0 + rel_at_cycle_ * at.pressure_amplitude / mean_amplitude_,
                                  kLeastFactor, kMostFactor);
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
  double factor_ = 1.0;
  bool started_ = false;
};

class Dependence final : public NamedEffect {
 public:
  Dependence()
      : NamedEffect("amplitude_dependent_delay", LoopBlock::kDelay,
                    {{"rel_at_cycle", "", 0.0, -0.6, 0.6, {0.01}}}) {}
  bool ChangesFlameCut() const override { return true; }
  bool ModulatesDelay() const override { return true; }
  double DelayFactor(const EffectContext& at, EffectValues x) const override {
    return 1.0 + x[0] * at.relative_amplitude;
  }
  double DelayPerAmplitude(EffectValues x) const override { return x[0]; }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<MovingDelay>(x[0], scale.mean_pressure_amplitude));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> AmplitudeDependentDelay() { return {std::make_shared<Dependence>()}; }

}  // namespace howl
