#include "diagnosis/budget/items/budget_item.h"

#include <algorithm>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

constexpr Eigen::Index kColouredCoefficients = 5;

bool IsTransfer(const EffectPointer& effect) { return effect->kind() == EffectKind::kTransfer; }

}  // namespace

std::vector<BudgetItem> BudgetItems(const BaseModel& model,
                                    const std::vector<std::string>& withheld,
                                    const std::vector<EffectPointer>& further) {
  std::vector<BudgetItem> items;
  for (const LoopNoise source :
       {LoopNoise::kHeatReleaseSensor, LoopNoise::kPressureSensor, LoopNoise::kDuct}) {
    items.push_back({std::string(LoopNoiseName(source)),
                     ItemKind::kNoise,
                     {source, kColouredCoefficients},
                     {}});
  }
  items.push_back({"complex_residues", ItemKind::kComplexResidues, {}, {}});
  items.push_back({"acoustic_mode", ItemKind::kMode, {}, {}});
  std::vector<EffectPointer> effects = Catalogue(model.modes, model.harmonic_ratio);
  effects.insert(effects.end(), further.begin(), further.end());
  for (const EffectPointer& effect : effects) {
    const std::string id(effect->id());
    if (!IsTransfer(effect) || std::ranges::find(withheld, id) != withheld.end()) continue;
    const auto same = std::ranges::find(items, id, &BudgetItem::id);
    if (same != items.end()) {
      same->forms.push_back(effect);
    } else {
      items.push_back({id, ItemKind::kEffect, {}, {effect}});
    }
  }
  return items;
}

}  // namespace howl
