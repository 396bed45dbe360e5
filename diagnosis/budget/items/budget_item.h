// What a budget adds to the base, one at a time: a source of noise, a freedom of the acoustics that
// each operating point has by itself, or an effect of the catalogue.
//
//   p_sensor_noise, q_sensor_noise   the sensor's noise is coloured (the base's is white)
//   duct_noise                       a source in the duct that q does not show (noise_sources.h)
//   complex_residues                 of the base's modes: p is measured elsewhere, or there is flow
//   acoustic_mode                    one more mode with its own damping; it may be added repeatedly
//   ID of the catalogue              an effect of transfer kind, its parameters shared by all
//   points
#ifndef HOWL_DIAGNOSIS_BUDGET_ITEMS_BUDGET_ITEM_H_
#define HOWL_DIAGNOSIS_BUDGET_ITEMS_BUDGET_ITEM_H_

#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/structure/structure_fit.h"

namespace howl {

enum class ItemKind : std::uint8_t { kNoise, kComplexResidues, kMode, kEffect };

struct BudgetItem {
  std::string id;
  ItemKind kind = ItemKind::kEffect;
  NoiseTerm noise;                   // of kNoise
  std::vector<EffectPointer> forms;  // of kEffect; one once it is fitted
  // Of kEffect, where it was fitted before: its parameters then, from which fits begin beside the
  // null in the place of the catalogue's starts.
  std::vector<double> fitted = {};
};

// Everything that may be added to the base of these records, effects last.
std::vector<BudgetItem> BudgetItems(const BaseModel& model,
                                    const std::vector<std::string>& withheld,
                                    const std::vector<EffectPointer>& further);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_ITEMS_BUDGET_ITEM_H_
