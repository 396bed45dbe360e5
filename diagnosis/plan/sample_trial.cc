#include "diagnosis/plan/sample_trial.h"

#include "diagnosis/records/channel_signal.h"
#include "model/effects/catalogue.h"

namespace howl {
namespace {

constexpr double kClippingFactor = 1.1;
// A tone of the plan's own lies between the cycle and its harmonic.
constexpr double kToneOverCycle = 1.45;

// The catalogue's effect of this kind.
std::string EffectOfKind(const PlanRecords& at, EffectKind kind) {
  const BaseModel& model = (*at.records)[0].model;
  for (const EffectPointer& effect : Catalogue(model.modes, model.harmonic_ratio)) {
    if (effect->kind() == kind) return std::string(effect->id());
  }
  return "";
}

}  // namespace

std::optional<SampleTrial> TrialOf(const PlanRecords& at, const Effect& effect) {
  SampleTrial trial;
  // The second parameter stays at its null: the frequency of mains, a time of the catalogue's.
  const auto hold = [&](double value) {
    trial.others.emplace_back(effect.parameters()[1].name, value);
    return value;
  };
  if (IsLineKind(effect.kind())) {
    const bool hum = effect.kind() == EffectKind::kHum;
    trial.rival = EffectOfKind(at, hum ? EffectKind::kTone : EffectKind::kHum);
    trial.first = 0.01;
    trial.least = 1e-6;
    trial.most = 1.0;
    const double hz = hold(hum ? effect.parameters()[1].null_value
                               : kToneOverCycle * (*at.records)[0].at.cycle_frequency_hz);
    trial.at = [&at, hum, hz](double x) { return hum ? SeeHum(at, hz, x) : SeeTone(at, hz, x); };
  } else if (IsGainKind(effect.kind())) {
    const bool coloured = effect.kind() == EffectKind::kColouredGain;
    trial.rival =
        EffectOfKind(at, coloured ? EffectKind::kSwitchingGain : EffectKind::kColouredGain);
    trial.first = 0.05;
    trial.least = 1e-4;
    trial.most = 0.9;
    const double time_s = hold(effect.parameters()[1].null_value);
    trial.at = [&at, coloured, time_s](double x) {
      return SeeFluctuation(at, coloured, time_s, x);
    };
  } else if (effect.kind() == EffectKind::kClipping) {
    const Channel channel = ChannelOf(effect.block());
    trial.inverted = true;
    trial.first = 0.95;
    trial.factor = kClippingFactor;
    trial.least = 0.3;
    trial.most = 1.5;
    trial.at = [&at, channel](double x) { return SeeClipping(at, channel, x); };
  } else if (effect.kind() == EffectKind::kQuantisation) {
    trial.inverted = true;
    trial.first = 100.0;
    trial.least = 4.0;
    trial.most = 1e6;
    trial.at = [&at](double x) { return SeeLevels(at, x); };
  } else {
    return std::nullopt;
  }
  return trial;
}

}  // namespace howl
