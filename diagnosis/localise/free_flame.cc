#include <cmath>

#include "diagnosis/localise/free_factor.h"
#include "diagnosis/localise/free_slack.h"

namespace howl {
namespace {

constexpr int kFactorTerms = 4;

class FlameFactor final : public NamedEffect {
 public:
  explicit FlameFactor(double centre_hz)
      : NamedEffect("slack_flame_factor", LoopBlock::kFlame, FactorParameters(kFactorTerms)),
        centre_hz_(centre_hz) {}
  bool ChangesFlameCut() const override { return true; }
  Response FlameOut(double frequency_hz, const EffectContext& /*at*/,
                    EffectValues x) const override {
    return FreeFactor(frequency_hz, centre_hz_, x, {});
  }

 private:
  double centre_hz_;
};

class Section final : public NamedEffect {
 public:
  explicit Section(double cycle_hz)
      : NamedEffect("slack_flame_section", LoopBlock::kFlame, SectionParameters(cycle_hz)) {}
  bool ChangesFlameCut() const override { return true; }
  Response FlameOut(double frequency_hz, const EffectContext& /*at*/,
                    EffectValues x) const override {
    return FreeSection(frequency_hz, x);
  }
};

class Spread final : public NamedEffect {
 public:
  explicit Spread(double tau_s)
      : NamedEffect("slack_delay_spread", LoopBlock::kDelay,
                    {{"sigma_s", "s", 0.0, 1e-6 * tau_s, 0.6 * tau_s, {0.05 * tau_s}},
                     {"share", "", 0.0, -0.6, 0.6, {0.1}},
                     {"extra_s",
                      "s",
                      0.3 * tau_s,
                      0.1 * tau_s,
                      3.0 * tau_s,
                      {0.2 * tau_s, 0.4 * tau_s, 0.8 * tau_s},
                      ParameterScale::kLogarithmic}}) {}
  bool ChangesFlameCut() const override { return true; }
  Response FlameOut(double frequency_hz, const EffectContext& /*at*/,
                    EffectValues x) const override {
    const double w = kRadPerSPerHz * frequency_hz;
    return std::exp(-0.5 * std::pow(w * x[0], 2)) *
           (1.0 - x[1] + x[1] * std::polar(1.0, -w * x[2]));
  }
};

class MovingDelay final : public NamedEffect {
 public:
  MovingDelay()
      : NamedEffect("slack_delay_moving", LoopBlock::kDelay,
                    {{"over_phi", "", 0.0, -0.5, 0.5, {0.0}},
                     {"over_phi_squared", "", 0.0, -1.0, 1.0, {0.0}},
                     {"over_amplitude", "", 0.0, -0.5, 0.5, {0.0}}}) {}
  bool ChangesFlameCut() const override { return true; }
  bool ModulatesDelay() const override { return true; }
  double DelayFactor(const EffectContext& at, EffectValues x) const override {
    return 1.0 + x[0] * at.phi_position + x[1] * (at.phi_position * at.phi_position - 1.0 / 12.0) +
           x[2] * (at.relative_amplitude - 1.0);
  }
  double DelayPerAmplitude(EffectValues x) const override { return x[2]; }
};

class OnePoint final : public NamedEffect {
 public:
  explicit OnePoint(double phi_position)
      : NamedEffect("slack_operating_point", LoopBlock::kOperatingPoint,
                    {{"delay", "", 0.0, -0.5, 0.5, {0.0}}}),
        phi_position_(phi_position) {}
  bool ChangesFlameCut() const override { return true; }
  double DelayFactor(const EffectContext& at, EffectValues x) const override {
    return at.phi_position == phi_position_ ? 1.0 + x[0] : 1.0;
  }

 private:
  double phi_position_;
};

}  // namespace

std::vector<EffectPointer> FreeFlame(const SlackScale& scale) {
  return {std::make_shared<FlameFactor>(scale.centre_hz),
          std::make_shared<Section>(scale.cycle_hz)};
}

std::vector<EffectPointer> FreeDelay(const SlackScale& scale) {
  return {std::make_shared<Spread>(scale.tau_s), std::make_shared<MovingDelay>()};
}

std::vector<EffectPointer> FreePoint(double phi_position) {
  return {std::make_shared<OnePoint>(phi_position)};
}

}  // namespace howl
