// The flame's gain drops by a share and recovers at random times.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

// On and off for exponentially distributed times of mean dwell_s; starts on.
class Switching final : public LoopEffect {
 public:
  Switching(double gain_drop, double dwell_s) : gain_drop_(gain_drop), dwell_s_(dwell_s) {}
  std::unique_ptr<LoopEffect> Clone() const override { return std::make_unique<Switching>(*this); }
  void Start(const RigParameters& /*rig*/, double step_s, std::uint64_t seed) override {
    stream_ = RandomStream(seed);
    leave_ = -std::expm1(-step_s / dwell_s_);
    low_ = false;
  }
  void FlameIn(const LoopContext& /*at*/, std::span<double> v) override {
    for (double& x : v) {
      if (stream_.Uniform() < leave_) low_ = !low_;
      x *= low_ ? 1.0 - gain_drop_ : 1.0;
    }
  }

 private:
  double gain_drop_;
  double dwell_s_;
  double leave_ = 0.0;
  bool low_ = false;
  RandomStream stream_{0};
};

class Dropout final : public NamedEffect {
 public:
  Dropout()
      : NamedEffect("intermittency", LoopBlock::kFlame,
                    {{"gain_drop", "", 0.0, 0.0, 1.0, {}}, {"dwell_s", "s", 0.2, 1e-2, 10.0, {}}}) {
  }
  EffectKind kind() const override { return EffectKind::kSwitchingGain; }
  Separation SeparatedBy() const override { return Separation::kLongRecord; }
  bool ChangesFlameCut() const override { return true; }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<Switching>(x[0], x[1]));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> Intermittency(const CatalogueBase& /*base*/) {
  return {std::make_shared<Dropout>()};
}

}  // namespace howl
