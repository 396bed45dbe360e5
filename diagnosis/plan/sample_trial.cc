#include "diagnosis/plan/sample_trial.h"

namespace howl {
namespace {

constexpr double kClippingFactor = 1.1;
// A tone of the plan's own lies between the cycle and its harmonic.
constexpr double kToneOverCycle = 1.45;

}  // namespace

std::optional<SampleTrial> TrialOf(const PlanRecords& at, const Effect& effect) {
  const std::string id(effect.id());
  SampleTrial trial;
  // The second parameter stays at its null: the frequency of mains, a time of the catalogue's.
  const auto hold = [&](double value) {
    trial.others.emplace_back(effect.parameters()[1].name, value);
    return value;
  };
  if (id == "mains_hum" || id == "external_tone") {
    const bool hum = id == "mains_hum";
    trial.rival = hum ? "external_tone" : "mains_hum";
    trial.first = 0.01;
    trial.least = 1e-6;
    trial.most = 1.0;
    const double hz = hold(hum ? effect.parameters()[1].null_value
                               : kToneOverCycle * (*at.records)[0].at.cycle_frequency_hz);
    trial.at = [&at, hum, hz](double x) { return hum ? SeeHum(at, hz, x) : SeeTone(at, hz, x); };
  } else if (effect.kind() == EffectKind::kGain) {
    const bool coloured = id == "parametric_noise";
    trial.rival = coloured ? "intermittency" : "parametric_noise";
    trial.first = 0.05;
    trial.least = 1e-4;
    trial.most = 0.9;
    const double time_s = hold(effect.parameters()[1].null_value);
    trial.at = [&at, coloured, time_s](double x) {
      return SeeFluctuation(at, coloured, time_s, x);
    };
  } else if (effect.kind() == EffectKind::kClipping) {
    const bool pressure = id == "p_clipping";
    trial.inverted = true;
    trial.first = 0.95;
    trial.factor = kClippingFactor;
    trial.least = 0.3;
    trial.most = 1.5;
    trial.at = [&at, pressure](double x) { return SeeClipping(at, pressure, x); };
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
