#include "diagnosis/loop_budget/forms/loop_item.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/loop_budget/forms/shared_effect.h"

namespace howl {
namespace {

// Of a flame's gain, in cycles. Of a peak half way between two of them either has a fifth of the
// power in the wrong place; a memory of a tenth of a record is a drift.
constexpr std::array kGainMemories = {1.0, 4.0, 16.0};

LoopBlock BlockOf(LoopNoise source) {
  switch (source) {
    case LoopNoise::kPressureSensor:
    case LoopNoise::kPressureHum:
      return LoopBlock::kPressureInstrument;
    case LoopNoise::kHeatReleaseSensor:
    case LoopNoise::kHeatReleaseHum:
      return LoopBlock::kHeatReleaseInstrument;
    case LoopNoise::kFlameGain:
      return LoopBlock::kFlame;
    default:
      return LoopBlock::kSource;
  }
}

std::vector<LoopItem> MakeItems() {
  std::vector<LoopItem> out = {
      {"p_sensor_noise", LoopItemKind::kNoise, {LoopNoise::kPressureSensor, kSensorCoefficients}},
      {"q_sensor_noise",
       LoopItemKind::kNoise,
       {LoopNoise::kHeatReleaseSensor, kSensorCoefficients}},
      {"duct_noise", LoopItemKind::kNoise, {LoopNoise::kDuct, kSourceCoefficients}},
      {"background_noise", LoopItemKind::kNoise, {LoopNoise::kBackground, kSensorCoefficients}},
      {"mains_hum", LoopItemKind::kNoise, {LoopNoise::kHeatReleaseHum, kHumCoefficients, 50.0}},
      {"mains_hum", LoopItemKind::kNoise, {LoopNoise::kHeatReleaseHum, kHumCoefficients, 60.0}},
      {"mains_hum", LoopItemKind::kNoise, {LoopNoise::kPressureHum, kHumCoefficients, 50.0}},
      {"mains_hum", LoopItemKind::kNoise, {LoopNoise::kPressureHum, kHumCoefficients, 60.0}},
      {"mains_hum", LoopItemKind::kNoise, {LoopNoise::kHeatReleaseHum, 1}},
      {"mains_hum", LoopItemKind::kNoise, {LoopNoise::kPressureHum, 1}},
      {"external_tone", LoopItemKind::kNoise, {LoopNoise::kTone, 1}},
      {"noise_shape", LoopItemKind::kNoiseShape},
      {"mode_detuning", LoopItemKind::kDetuning},
      {"own_damping", LoopItemKind::kOwnDamping},
      {"complex_residues", LoopItemKind::kComplexResidues},
      {"extra_acoustic_mode", LoopItemKind::kMode},
      {std::string(kDelayDispersionId), LoopItemKind::kDelaySpread, {}, DelaySpread::kNormal},
      {"gamma_delays", LoopItemKind::kDelaySpread, {}, DelaySpread::kGamma},
      {std::string(kSecondPathId), LoopItemKind::kSecondPath},
      {"flame_input_pressure_rate",
       LoopItemKind::kFlameInput,
       {},
       DelaySpread::kNone,
       FlameInput::kPressureRate},
      {"flame_input_pressure",
       LoopItemKind::kFlameInput,
       {},
       DelaySpread::kNone,
       FlameInput::kPressure},
      {"flame_input_velocity",
       LoopItemKind::kFlameInput,
       {},
       DelaySpread::kNone,
       FlameInput::kVelocity}};
  out.push_back({.id = "nonlinear_damping",
                 .kind = LoopItemKind::kSlowChange,
                 .change = &PointStructure::damping_follows_amplitude});
  out.push_back({.id = "amplitude_dependent_delay",
                 .kind = LoopItemKind::kSlowChange,
                 .change = &PointStructure::delay_follows_amplitude});
  out.push_back({.id = "amplitude_dependent_gain",
                 .kind = LoopItemKind::kSlowChange,
                 .change = &PointStructure::gain_follows_amplitude});
  out.push_back({.id = "slow_drift",
                 .kind = LoopItemKind::kSlowChange,
                 .change = &PointStructure::frequency_drifts});
  out.push_back({.id = "acoustic_line_errors",
                 .kind = LoopItemKind::kLineErrors,
                 .lines = &PointStructure::acoustic_lines});
  out.push_back({.id = "flame_line_errors",
                 .kind = LoopItemKind::kLineErrors,
                 .lines = &PointStructure::flame_lines});
  for (const bool before_curve : {false, true}) {
    for (const double memory_cycles : kGainMemories) {
      out.push_back({.id = "parametric_noise",
                     .kind = LoopItemKind::kNoise,
                     .noise = {LoopNoise::kFlameGain, 1, 0.0, memory_cycles, before_curve}});
    }
  }
  for (const EffectPointer& effect : SharedEffects()) {
    out.push_back(SharedItem(effect));
  }
  return out;
}

}  // namespace

LoopBlock BlockOf(const LoopItem& item) {
  switch (item.kind) {
    case LoopItemKind::kNoise:
      return BlockOf(item.noise.source);
    case LoopItemKind::kNoiseShape:
      return LoopBlock::kSource;
    case LoopItemKind::kDetuning:
    case LoopItemKind::kOwnDamping:
    case LoopItemKind::kComplexResidues:
    case LoopItemKind::kMode:
      return LoopBlock::kAcoustics;
    case LoopItemKind::kDelaySpread:
    case LoopItemKind::kSecondPath:
      return LoopBlock::kDelay;
    case LoopItemKind::kFlameInput:
      return LoopBlock::kFlame;
    case LoopItemKind::kSharedEffect:
      return item.effect->block();
    case LoopItemKind::kSlowChange:
      if (item.change == &PointStructure::delay_follows_amplitude) return LoopBlock::kDelay;
      return item.change == &PointStructure::gain_follows_amplitude ? LoopBlock::kFlame
                                                                    : LoopBlock::kAcoustics;
    case LoopItemKind::kLineErrors:
      return item.lines == &PointStructure::flame_lines ? LoopBlock::kFlame : LoopBlock::kAcoustics;
  }
  LOG(FATAL) << "an item of no kind";
}

LoopItem SharedItem(const EffectPointer& effect) {
  return {.id = std::string(effect->id()), .kind = LoopItemKind::kSharedEffect, .effect = effect};
}

const std::vector<LoopItem>& AllLoopItems() {
  static const std::vector<LoopItem> kItems = MakeItems();
  return kItems;
}

std::vector<std::string> LoopItemIds() {
  std::vector<std::string> out;
  for (const LoopItem& item : AllLoopItems()) {
    if (std::ranges::find(out, item.id) == out.end()) out.push_back(item.id);
  }
  return out;
}

std::string FormOf(const LoopItem& item) {
  if (item.noise.before_curve) return "side before_flame";
  if (!item.effect) return "";
  const EffectForm form = item.effect->form();
  return form.key.empty() ? "" : form.key + " " + form.value;
}

std::string KeyOf(const LoopItem& item) {
  if (IsHum(item.noise.source)) {
    return item.id + "_" + std::string(LoopNoiseName(item.noise.source)) + "_" +
           std::to_string(std::lround(item.noise.line_hz));
  }
  if (item.noise.source == LoopNoise::kFlameGain) {
    return item.id + std::to_string(std::lround(item.noise.memory_cycles)) +
           (item.noise.before_curve ? "before" : "");
  }
  return item.id + (item.effect ? item.effect->form().value : "");
}

}  // namespace howl
