// A share of the flame answers after a second, longer delay: 1 - share + share e^(-extra s).
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Path final : public NamedEffect {
 public:
  explicit Path(bool before)
      : NamedEffect("second_delay_path", LoopBlock::kDelay,
                    {{"share", "", 0.0, -0.6, 0.6, {0.1, 0.3}},
                     {"extra_s",
                      "s",
                      1e-3,
                      4e-4,
                      1e-2,
                      {6e-4, 1.2e-3, 2e-3, 3e-3, 5e-3},
                      ParameterScale::kLogarithmic}}),
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
    if (x[0] == 0.0) return 1.0;
    return 1.0 - x[0] + x[0] * std::polar(1.0, -kRadPerSPerHz * frequency_hz * x[1]);
  }

  bool before_;
};

}  // namespace

std::vector<EffectPointer> SecondDelayPath() {
  return {std::make_shared<Path>(true), std::make_shared<Path>(false)};
}

}  // namespace howl
