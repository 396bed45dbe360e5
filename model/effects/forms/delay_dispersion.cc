// The delay is spread normally with standard deviation sigma: e^(-(2 pi f sigma)^2 / 2), on the way
// to the flame or, each parcel burning by itself, after it.
#include <array>
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

// The normal density at equal distances of 3/4 sigma up to 4.5 sigma, by the trapezoidal rule:
// exact to 1e-5 up to 2 pi f sigma = 3.
constexpr int kHalf = 6;
constexpr double kSpacing = 0.75;

class SpreadDelay final : public LoopEffect {
 public:
  SpreadDelay(double sigma_s, bool before) : sigma_s_(sigma_s), before_(before) {
    double sum = 0.0;
    for (int k = -kHalf; k <= kHalf; ++k) sum += std::exp(-0.5 * std::pow(kSpacing * k, 2));
    for (int k = -kHalf; k <= kHalf; ++k) {
      weights_[k + kHalf] = std::exp(-0.5 * std::pow(kSpacing * k, 2)) / sum;
    }
  }
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<SpreadDelay>(*this);
  }
  double ShortestDelay(double tau_s) const override { return tau_s - kHalf * kSpacing * sigma_s_; }
  double LongestDelay(double tau_s) const override { return tau_s + kHalf * kSpacing * sigma_s_; }
  void FlameIn(const LoopContext& at, std::span<double> v) override {
    if (before_) Spread(at, v);
  }
  void FlameOut(const LoopContext& at, std::span<double> heat_release) override {
    if (!before_) Spread(at, heat_release);
  }

 private:
  // The middle node is the signal itself.
  void Spread(const LoopContext& at, std::span<double> signal) {
    if (sigma_s_ == 0.0) return;
    std::array<double, kLoopBlock> delays;
    std::array<double, kLoopBlock> values;
    const std::size_t n = signal.size();
    for (double& x : signal) x *= weights_[kHalf];
    for (int k = -kHalf; k <= kHalf; ++k) {
      if (k == 0) continue;
      for (std::size_t i = 0; i < n; ++i) delays[i] = at.tau_s[i] + kSpacing * k * sigma_s_;
      at.delay_line->Read({delays.data(), n}, {values.data(), n});
      const double weight = weights_[k + kHalf];
      for (std::size_t i = 0; i < n; ++i) {
        signal[i] += weight * (before_ ? values[i] : FlameResponse(at.flame, values[i]));
      }
    }
  }

  double sigma_s_;
  bool before_;
  std::array<double, 2 * kHalf + 1> weights_{};
};

class Dispersion final : public NamedEffect {
 public:
  explicit Dispersion(bool before)
      : NamedEffect("delay_dispersion", LoopBlock::kDelay,
                    {{"sigma_s", "s", 0.0, 1e-6, 2e-3, {1e-4, 3e-4}}}),
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
  std::string SimulationFault(const RigParameters& rig, EffectValues x) const override {
    const double most = rig.model.loop.tau_s / 6.0;
    if (x[0] <= most) return "";
    return "sigma_s is above a sixth of the delay, expected at most " + std::to_string(most) +
           " s: nothing burns before it is fed";
  }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->effects.push_back(std::make_shared<SpreadDelay>(x[0], before_));
    return true;
  }

 private:
  static Response Factor(double frequency_hz, EffectValues x) {
    const double angle = kRadPerSPerHz * frequency_hz * x[0];
    return std::exp(-0.5 * angle * angle);
  }

  bool before_;
};

}  // namespace

std::vector<EffectPointer> DelayDispersion(const CatalogueBase& /*base*/) {
  return {std::make_shared<Dispersion>(true), std::make_shared<Dispersion>(false)};
}

}  // namespace howl
