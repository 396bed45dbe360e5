#include "diagnosis/loop_budget/loop_item.h"

#include <algorithm>

#include "estimation/joint_records/record_loop_spec.h"

namespace howl {
namespace {

// Coefficients of a source's logarithm over the band's: as many as show peaks an octave wide of a
// source that the loop shapes, and half an octave more of a sensor's.
constexpr Eigen::Index kOfSource = 6;
constexpr Eigen::Index kOfSensor = 4;

const NoiseTerm* TermOf(const LoopForm& model, LoopNoise source) {
  const auto at = std::ranges::find(model.structure.noise, source, &NoiseTerm::source);
  return at == model.structure.noise.end() ? nullptr : &*at;
}

std::vector<LoopItem> MakeItems() {
  std::vector<LoopItem> out = {
      {"p_sensor_noise", LoopItemKind::kNoise, {LoopNoise::kPressureSensor, kOfSensor}},
      {"q_sensor_noise", LoopItemKind::kNoise, {LoopNoise::kHeatReleaseSensor, kOfSensor}},
      {"duct_noise", LoopItemKind::kNoise, {LoopNoise::kDuct, kOfSource}},
      {"background_noise", LoopItemKind::kNoise, {LoopNoise::kBackground, kOfSensor}},
      {"mode_detuning", LoopItemKind::kDetuning},
      {"own_damping", LoopItemKind::kOwnDamping},
      {"complex_residues", LoopItemKind::kComplexResidues},
      {"acoustic_mode", LoopItemKind::kMode},
      {"delay_dispersion", LoopItemKind::kDelaySpread, {}, DelaySpread::kNormal},
      {"gamma_delays", LoopItemKind::kDelaySpread, {}, DelaySpread::kGamma},
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
  for (const EffectPointer& effect : InstrumentsOfHeatRelease()) {
    out.push_back(
        {.id = std::string(effect->id()), .kind = LoopItemKind::kInstrument, .instrument = effect});
  }
  return out;
}

const std::vector<LoopItem>& AllItems() {
  static const std::vector<LoopItem> kItems = MakeItems();
  return kItems;
}

bool MayBeAdded(const LoopItem& item, const LoopForm& model, const LoopForm& base) {
  const PointStructure& now = model.structure;
  switch (item.kind) {
    case LoopItemKind::kNoise: {
      const NoiseTerm* const term = TermOf(model, item.noise.source);
      return term == nullptr || term->coefficients < item.noise.coefficients;
    }
    case LoopItemKind::kDetuning:
      return now.ratio.has_value() && now.modes > 1;
    case LoopItemKind::kOwnDamping:
      return !now.own_damping && now.modes > 1;
    case LoopItemKind::kComplexResidues:
      return !now.complex_residues;
    case LoopItemKind::kMode:
      // One more of modes that are tied to one another would have no frequency of its own.
      return !now.ratio && now.own_damping && now.modes < kMostModes;
    case LoopItemKind::kDelaySpread:
      return now.delay_spread == DelaySpread::kNone;
    case LoopItemKind::kFlameInput:
      return model.flame_input == base.flame_input && item.input != base.flame_input;
    case LoopItemKind::kInstrument:
      return std::ranges::none_of(model.instruments, [&](const LoopInstrument& each) {
        return each.effect->id() == item.instrument->id();
      });
  }
  return false;
}

void SetNoise(const NoiseTerm& term, std::vector<NoiseTerm>* noise) {
  const auto at = std::ranges::find(*noise, term.source, &NoiseTerm::source);
  if (at == noise->end()) {
    noise->push_back(term);
  } else {
    *at = term;
  }
  // A background's ratio is the last parameter.
  std::ranges::stable_sort(*noise, {}, &NoiseTerm::source);
}

}  // namespace

std::vector<NoiseTerm> LeastNoise() {
  return {{LoopNoise::kCombustion, kOfSource},
          {LoopNoise::kPressureSensor, 1},
          {LoopNoise::kHeatReleaseSensor, 1}};
}

std::vector<std::string> LoopItemIds() {
  std::vector<std::string> out;
  for (const LoopItem& item : AllItems()) {
    if (std::ranges::find(out, item.id) == out.end()) out.push_back(item.id);
  }
  return out;
}

std::string KeyOf(const LoopItem& item) {
  return item.id + (item.instrument ? item.instrument->form().value : "");
}

std::vector<LoopItem> LoopItems(const LoopForm& model, const LoopForm& base) {
  std::vector<LoopItem> out;
  for (const LoopItem& item : AllItems()) {
    if (MayBeAdded(item, model, base)) out.push_back(item);
  }
  return out;
}

LoopForm With(LoopForm model, const LoopItem& item) {
  PointStructure& structure = model.structure;
  switch (item.kind) {
    case LoopItemKind::kNoise:
      SetNoise(item.noise, &structure.noise);
      break;
    case LoopItemKind::kDetuning:
      structure.ratio.reset();
      break;
    case LoopItemKind::kOwnDamping:
      structure.own_damping = true;
      break;
    case LoopItemKind::kComplexResidues:
      structure.complex_residues = true;
      break;
    case LoopItemKind::kMode:
      ++structure.modes;
      break;
    case LoopItemKind::kDelaySpread:
      structure.delay_spread = item.spread;
      break;
    case LoopItemKind::kFlameInput:
      model.flame_input = item.input;
      break;
    case LoopItemKind::kInstrument:
      model.instruments.push_back({item.instrument, item.instrument->parameters()[0].null_value});
      break;
  }
  return model;
}

LoopForm Without(LoopForm model, const LoopItem& item, const LoopForm& base) {
  PointStructure& structure = model.structure;
  switch (item.kind) {
    case LoopItemKind::kNoise:
      if (const NoiseTerm* const term = TermOf(base, item.noise.source)) {
        SetNoise(*term, &structure.noise);
      } else {
        std::erase_if(structure.noise,
                      [&](const NoiseTerm& each) { return each.source == item.noise.source; });
      }
      break;
    case LoopItemKind::kDetuning:
      structure.ratio = base.structure.ratio;
      structure.modes = base.structure.modes;
      break;
    case LoopItemKind::kOwnDamping:
      structure.own_damping = false;
      structure.modes = base.structure.modes;
      break;
    case LoopItemKind::kComplexResidues:
      structure.complex_residues = false;
      break;
    case LoopItemKind::kMode:
      --structure.modes;
      break;
    case LoopItemKind::kDelaySpread:
      structure.delay_spread = DelaySpread::kNone;
      break;
    case LoopItemKind::kFlameInput:
      model.flame_input = base.flame_input;
      break;
    case LoopItemKind::kInstrument:
      std::erase_if(model.instruments, [&](const LoopInstrument& each) {
        return each.effect->id() == item.instrument->id();
      });
      break;
  }
  return model;
}

}  // namespace howl
