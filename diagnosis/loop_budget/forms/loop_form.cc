#include "diagnosis/loop_budget/forms/loop_form.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/samples/mains.h"

namespace howl {
namespace {

bool IsOfMains(double line_hz) {
  return std::ranges::any_of(kMains_hz, [line_hz](double mains_hz) {
    const double multiple = std::max(std::round(line_hz / mains_hz), 1.0);
    return std::abs(line_hz / (multiple * mains_hz) - 1.0) < kMainsWander;
  });
}

// Of a source that has any shape.
Eigen::Index Fine(Eigen::Index coefficients) { return coefficients > 1 ? 2 * coefficients : 1; }

void Refine(NoiseTerm* term) {
  if (!HasLines(term->source)) term->coefficients = Fine(term->coefficients);
}

NoiseTerm TermIn(const LoopForm& model, NoiseTerm term) {
  if (model.fine_noise) Refine(&term);
  return term;
}

const NoiseTerm* TermOf(const LoopForm& model, LoopNoise source) {
  const auto at = std::ranges::find(model.structure.noise, source, &NoiseTerm::source);
  return at == model.structure.noise.end() ? nullptr : &*at;
}

bool HasShared(const LoopForm& model, std::string_view id) {
  return std::ranges::any_of(model.effects,
                             [&](const SharedEffect& each) { return each.effect->id() == id; });
}

bool StandsBehindCurve(const PointStructure& structure, std::string_view id) {
  return (id == kSecondPathId && structure.second_path) ||
         (id == kDelayDispersionId && structure.HasSpread());
}

bool MayBeAdded(const LoopItem& item, const LoopForm& model, const LoopForm& base) {
  const PointStructure& now = model.structure;
  switch (item.kind) {
    case LoopItemKind::kNoise: {
      if (HasLines(item.noise.source) && item.noise.line_hz == 0.0) return false;
      const NoiseTerm* const term = TermOf(model, item.noise.source);
      return term == nullptr || term->coefficients < item.noise.coefficients;
    }
    case LoopItemKind::kNoiseShape:
      return !model.fine_noise;
    case LoopItemKind::kDetuning:
      return now.ratio.has_value() && now.FirstModes() > 1;
    case LoopItemKind::kOwnDamping:
      return !now.own_damping && now.FirstModes() > 1;
    case LoopItemKind::kComplexResidues:
      return !now.complex_residues;
    case LoopItemKind::kMode:
      return now.modes < kMostModes;
    case LoopItemKind::kDelaySpread:
      return !now.HasSpread() && !HasShared(model, kDelayDispersionId);
    case LoopItemKind::kSecondPath:
      return !now.second_path && !HasShared(model, item.id);
    case LoopItemKind::kFlameInput:
      return model.flame_input == base.flame_input && item.input != base.flame_input;
    case LoopItemKind::kSharedEffect:
      return !HasShared(model, item.id) && !StandsBehindCurve(now, item.id);
    case LoopItemKind::kSlowChange:
      return !(now.*item.change);
    case LoopItemKind::kLineErrors:
      return now.*item.lines == 0;
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
  return {{LoopNoise::kCombustion, kSourceCoefficients},
          {LoopNoise::kPressureSensor, 1},
          {LoopNoise::kHeatReleaseSensor, 1}};
}

LoopForm LeastForm(const RecordLoopSpec& spec) {
  LoopForm out{StructureOf(spec, spec.modes), spec.flame_input};
  out.structure.noise = LeastNoise();
  out.structure.acoustic_lines = out.structure.flame_lines = 0;
  return out;
}

LoopForm PapersForm(int modes, double ratio) {
  RecordLoopSpec spec;
  spec.modes = modes;
  if (modes > 1) spec.ratio = ratio;
  spec.own_damping = false;
  spec.complex_residues = false;
  return LeastForm(spec);
}

std::vector<LoopItem> LoopItems(const LoopForm& model, const LoopForm& base,
                                const std::vector<EffectPointer>& declared) {
  std::vector<LoopItem> out;
  for (LoopItem item : AllLoopItems()) {
    const bool hum = IsHum(item.noise.source);
    if (HasOneLine(item.noise) && (!hum || IsOfMains(base.tone_hz))) {
      item.noise.line_hz = base.tone_hz;
    }
    if (MayBeAdded(item, model, base)) out.push_back(std::move(item));
  }
  for (const EffectPointer& effect : declared) {
    if (!HasShared(model, effect->id())) out.push_back(SharedItem(effect));
  }
  return out;
}

std::vector<LoopItem> SharedItemsOf(const LoopForm& model) {
  std::vector<LoopItem> out;
  for (const SharedEffect& each : model.effects) out.push_back(SharedItem(each.effect));
  return out;
}

LoopForm With(LoopForm model, const LoopItem& item) {
  PointStructure& structure = model.structure;
  switch (item.kind) {
    case LoopItemKind::kNoise:
      SetNoise(TermIn(model, item.noise), &structure.noise);
      break;
    case LoopItemKind::kNoiseShape:
      model.fine_noise = true;
      for (NoiseTerm& term : structure.noise) Refine(&term);
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
      ++structure.further_modes;
      break;
    case LoopItemKind::kDelaySpread:
      structure.delay_spread = item.spread;
      break;
    case LoopItemKind::kSecondPath:
      structure.second_path = true;
      break;
    case LoopItemKind::kFlameInput:
      model.flame_input = item.input;
      break;
    case LoopItemKind::kSharedEffect:
      model.effects.push_back({item.effect, NullValues(*item.effect)});
      break;
    case LoopItemKind::kSlowChange:
      structure.*item.change = true;
      break;
    case LoopItemKind::kLineErrors:
      structure.*item.lines = kCycleLines;
      break;
  }
  return model;
}

LoopForm Without(LoopForm model, const LoopItem& item, const LoopForm& base) {
  PointStructure& structure = model.structure;
  switch (item.kind) {
    case LoopItemKind::kNoise:
      if (const NoiseTerm* const term = TermOf(base, item.noise.source)) {
        SetNoise(TermIn(model, *term), &structure.noise);
      } else {
        std::erase_if(structure.noise,
                      [&](const NoiseTerm& each) { return each.source == item.noise.source; });
      }
      break;
    case LoopItemKind::kNoiseShape:
      model.fine_noise = false;
      for (NoiseTerm& term : structure.noise) {
        if (term.coefficients > 1 && !HasLines(term.source)) term.coefficients /= 2;
      }
      break;
    case LoopItemKind::kDetuning:
      structure.ratio = base.structure.ratio;
      break;
    case LoopItemKind::kOwnDamping:
      structure.own_damping = false;
      break;
    case LoopItemKind::kComplexResidues:
      structure.complex_residues = false;
      break;
    case LoopItemKind::kMode:
      --structure.modes;
      --structure.further_modes;
      break;
    case LoopItemKind::kDelaySpread:
      structure.delay_spread = DelaySpread::kNone;
      break;
    case LoopItemKind::kSecondPath:
      structure.second_path = false;
      break;
    case LoopItemKind::kFlameInput:
      model.flame_input = base.flame_input;
      break;
    case LoopItemKind::kSharedEffect:
      std::erase_if(model.effects, [&](const SharedEffect& each) {
        return each.effect->id() == item.effect->id();
      });
      break;
    case LoopItemKind::kSlowChange:
      structure.*item.change = false;
      break;
    case LoopItemKind::kLineErrors:
      structure.*item.lines = 0;
      break;
  }
  return model;
}

}  // namespace howl
