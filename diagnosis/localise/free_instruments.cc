#include <cmath>

#include "diagnosis/localise/free_factor.h"
#include "diagnosis/localise/free_slack.h"

namespace howl {
namespace {

constexpr int kTerms = 5;

class PressureFactor final : public NamedEffect {
 public:
  explicit PressureFactor(double centre_hz)
      : NamedEffect("slack_p_factor", LoopBlock::kPressureInstrument, FactorParameters(kTerms)),
        centre_hz_(centre_hz) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  bool ChangesFlameInput() const override { return true; }
  Response PressureInstrument(double frequency_hz, EffectValues x) const override {
    return FreeFactor(frequency_hz, centre_hz_, x, {});
  }

 private:
  double centre_hz_;
};

EffectParameter Shift(double cycle_hz) {
  return {"shift_s", "s", 0.0, -0.3 / cycle_hz, 0.3 / cycle_hz, {0.0}};
}

std::vector<EffectParameter> WithShift(double cycle_hz, std::vector<EffectParameter> further) {
  further.insert(further.begin(), Shift(cycle_hz));
  return further;
}

class HeatReleaseFactor final : public NamedEffect {
 public:
  explicit HeatReleaseFactor(const SlackScale& scale)
      : NamedEffect("slack_q_factor", LoopBlock::kHeatReleaseInstrument,
                    WithShift(scale.cycle_hz, FactorParameters(kTerms))),
        centre_hz_(scale.centre_hz) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override {
    return std::polar(1.0, -kRadPerSPerHz * frequency_hz * x[0]) *
           FreeFactor(frequency_hz, centre_hz_, x.subspan(1), {});
  }

 private:
  double centre_hz_;
};

class Leak final : public NamedEffect {
 public:
  explicit Leak(double cycle_hz)
      : NamedEffect("slack_q_leak", LoopBlock::kHeatReleaseInstrument,
                    WithShift(cycle_hz, {{"share", "", 0.0, -0.6, 0.6, {0.0}}})) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override {
    return std::polar(1.0, -kRadPerSPerHz * frequency_hz * x[0]);
  }
  Response PressureLeak(double /*frequency_hz*/, const EffectContext& at,
                        EffectValues x) const override {
    return x[1] * at.heat_release_over_pressure;
  }
};

class PressureSection final : public NamedEffect {
 public:
  explicit PressureSection(double cycle_hz)
      : NamedEffect("slack_p_section", LoopBlock::kPressureInstrument,
                    SectionParameters(cycle_hz)) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  bool ChangesFlameInput() const override { return true; }
  Response PressureInstrument(double frequency_hz, EffectValues x) const override {
    return FreeSection(frequency_hz, x);
  }
};

class HeatReleaseSection final : public NamedEffect {
 public:
  explicit HeatReleaseSection(double cycle_hz)
      : NamedEffect("slack_q_section", LoopBlock::kHeatReleaseInstrument,
                    WithShift(cycle_hz, SectionParameters(cycle_hz))) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override {
    return std::polar(1.0, -kRadPerSPerHz * frequency_hz * x[0]) *
           FreeSection(frequency_hz, x.subspan(1));
  }
};

}  // namespace

std::vector<EffectPointer> FreePressureInstrument(const SlackScale& scale) {
  return {std::make_shared<PressureFactor>(scale.centre_hz),
          std::make_shared<PressureSection>(scale.cycle_hz)};
}

std::vector<EffectPointer> FreeHeatReleaseInstrument(const SlackScale& scale) {
  return {std::make_shared<HeatReleaseFactor>(scale),
          std::make_shared<HeatReleaseSection>(scale.cycle_hz),
          std::make_shared<Leak>(scale.cycle_hz)};
}

}  // namespace howl
