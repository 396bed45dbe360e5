// A share of the flame answers after a second, longer delay: 1 - share + share e^(-extra s).
#include <array>
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

class SecondPath final : public LoopEffect {
 public:
  SecondPath(double share, double extra_s, bool before)
      : share_(share), extra_s_(extra_s), before_(before) {}
  std::unique_ptr<LoopEffect> Clone() const override { return std::make_unique<SecondPath>(*this); }
  double LongestDelay(double tau_s) const override { return tau_s + extra_s_; }
  void FlameIn(const LoopContext& at, std::span<double> v) override {
    if (before_) Mix(at, v);
  }
  void FlameOut(const LoopContext& at, std::span<double> heat_release) override {
    if (!before_) Mix(at, heat_release);
  }

 private:
  void Mix(const LoopContext& at, std::span<double> signal) {
    if (share_ == 0.0) return;
    std::array<double, kLoopBlock> delays;
    std::array<double, kLoopBlock> values;
    const std::size_t n = signal.size();
    for (std::size_t i = 0; i < n; ++i) delays[i] = at.tau_s[i] + extra_s_;
    at.delay_line->Read({delays.data(), n}, {values.data(), n});
    for (std::size_t i = 0; i < n; ++i) {
      const double later = before_ ? values[i] : FlameResponse(at.flame, values[i]);
      signal[i] = (1.0 - share_) * signal[i] + share_ * later;
    }
  }

  double share_;
  double extra_s_;
  bool before_;
};

class Path final : public NamedEffect {
 public:
  explicit Path(bool before)
      : NamedEffect("second_delay_path", LoopBlock::kDelay,
                    {{"share", "", 0.0, 0.0, 0.6, {0.1, 0.3}},
                     {"extra_s",
                      "s",
                      1e-3,
                      4e-4,
                      1e-2,
                      {6e-4, 1.2e-3, 2e-3, 3e-3, 5e-3},
                      ParameterScale::kLogarithmic}}),
        before_(before) {}
  Separation SeparatedBy() const override { return Separation::kHighFrequencies; }
  bool ChangesFlameCut() const override { return true; }
  bool ChangesFlameInput() const override { return before_; }
  Response FlameIn(double frequency_hz, const EffectContext& /*at*/,
                   EffectValues x) const override {
    return before_ ? Factor(frequency_hz, x) : 1.0;
  }
  Response FlameOut(double frequency_hz, const EffectContext& /*at*/,
                    EffectValues x) const override {
    return before_ ? 1.0 : Factor(frequency_hz, x);
  }
  EffectForm form() const override { return {"side", before_ ? "before_flame" : "after_flame"}; }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<SecondPath>(x[0], x[1], before_));
    return true;
  }

 private:
  static Response Factor(double frequency_hz, EffectValues x) {
    if (x[0] == 0.0) return 1.0;
    return 1.0 - x[0] + x[0] * std::polar(1.0, -kRadPerSPerHz * frequency_hz * x[1]);
  }

  bool before_;
};

}  // namespace

std::vector<EffectPointer> SecondDelayPath(const CatalogueBase& /*base*/) {
  return {std::make_shared<Path>(true), std::make_shared<Path>(false)};
}

}  // namespace howl
