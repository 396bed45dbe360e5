#include "diagnosis/budget/items/item_removal.h"

#include <glog/logging.h>

#include <algorithm>

namespace howl {

EffectPlace PlaceOf(const StructureFit& fit, const BudgetItem& item) {
  EffectPlace out;
  for (const EffectPointer& effect : fit.structure.effects) {
    if (effect->id() == item.id) return out;
    ++out.number;
    out.first_value += effect->parameters().size();
  }
  LOG(FATAL) << item.id << " is not in the structure";
}

StructureFit Without(const StructureFit& from, const std::vector<BudgetItem>& items,
                     std::size_t which) {
  StructureFit out = from;
  const BudgetItem& item = items[which];
  switch (item.kind) {
    case ItemKind::kNoise: {
      const auto term =
          std::ranges::find(out.structure.noise, item.noise.source, &NoiseTerm::source);
      CHECK(term != out.structure.noise.end());
      const auto j = term - out.structure.noise.begin();
      const bool of_base = static_cast<std::size_t>(j) < BaseNoise().size();
      for (std::vector<PointLoop>* all : {&out.points, &out.centres}) {
        for (PointLoop& point : *all) {
          if (of_base) {
            point.noise[static_cast<std::size_t>(j)].conservativeResize(1);
          } else {
            point.noise.erase(point.noise.begin() + j);
          }
        }
      }
      if (of_base) {
        term->coefficients = 1;
      } else {
        out.structure.noise.erase(term);
      }
      return out;
    }
    case ItemKind::kComplexResidues:
      out.structure.complex_residues = false;
      for (std::vector<PointLoop>* all : {&out.points, &out.centres}) {
        for (PointLoop& point : *all) point.base_b.resize(0);
      }
      return out;
    case ItemKind::kMode: {
      std::ptrdiff_t before = 0;  // modes that were added earlier
      for (std::size_t i = 0; i < which; ++i) before += items[i].kind == item.kind ? 1 : 0;
      --out.structure.further_modes;
      for (std::vector<PointLoop>* all : {&out.points, &out.centres}) {
        for (PointLoop& point : *all) point.modes.erase(point.modes.begin() + before);
      }
      return out;
    }
    case ItemKind::kEffect:
      break;
  }
  const EffectPlace place = PlaceOf(out, item);
  const auto first = place.first_value;
  const std::size_t values = out.structure.effects[place.number]->parameters().size();
  out.shared.values.erase(out.shared.values.begin() + static_cast<std::ptrdiff_t>(first),
                          out.shared.values.begin() + static_cast<std::ptrdiff_t>(first + values));
  out.structure.effects.erase(out.structure.effects.begin() +
                              static_cast<std::ptrdiff_t>(place.number));
  return out;
}

}  // namespace howl
