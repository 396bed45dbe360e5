// The delay is spread normally with standard deviation sigma: e^(-(2 pi f sigma)^2 / 2), on the way
// to the flame or, each parcel burning by itself, after it.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Dispersion final : public NamedEffect {
 public:
  explicit Dispersion(bool before)
      : NamedEffect("delay_dispersion", LoopBlock::kDelay,
                    {{"sigma_s", "s", 0.0, 1e-6, 2e-3, {1e-4, 3e-4}}}),
        before_(before) {}
  bool ChangesFlameCut() const override { return true; }
  bool ChangesFlameInput() const override { return before_; }
  Response FlameIn(double frequency_hz, const EffectContext& /*at*/,
                   EffectValues x) const override {
    return before_ ? Factor(frequency_hz, x) : 1.0;
  }
  Response FlameOut(double frequency_hz, EffectValues x) const override {
    return before_ ? 1.0 : Factor(frequency_hz, x);
  }

 private:
  static Response Factor(double frequency_hz, EffectValues x) {
    const double angle = kRadPerSPerHz * frequency_hz * x[0];
    return std::exp(-0.5 * angle * angle);
  }

  bool before_;
};

}  // namespace

std::vector<EffectPointer> DelayDispersion() {
  return {std::make_shared<Dispersion>(true), std::make_shared<Dispersion>(false)};
}

}  // namespace howl
