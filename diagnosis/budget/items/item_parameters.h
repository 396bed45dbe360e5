// What a budget's item is in numbers. An effect has its parameters, with intervals. A mode has the
// frequency and the damping, a source of noise the amplitude relative to the signal in which it
// shows, complex residues the angle of the first mode's: the mean over the operating points, which
// have each their own, between the least and the largest.
#ifndef HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_PARAMETERS_H_
#define HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_PARAMETERS_H_

#include <vector>

#include "diagnosis/budget/items/budget_item.h"
#include "diagnosis/fit/estimated_parameter.h"

namespace howl {

std::vector<EstimatedParameter> ItemParameters(const std::vector<JointBand>& bands,
                                               const StructureFit& fit,
                                               const std::vector<BudgetItem>& items,
                                               std::size_t which);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_PARAMETERS_H_
