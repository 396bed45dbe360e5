// What an item of a budget is in numbers: the mean over the operating points of the best loop,
// between the least and the largest; of a shared effect the values, with their intervals.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LOOP_ITEM_PARAMETERS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LOOP_ITEM_PARAMETERS_H_

#include <vector>

#include "diagnosis/fit/estimated_parameter.h"
#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

// `mode`: where an item is a mode, its place among the loop's.
std::vector<EstimatedParameter> LoopItemParameters(const LoopRecords& records, const LoopFit& fit,
                                                   const LoopItem& item, std::size_t mode,
                                                   const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LOOP_ITEM_PARAMETERS_H_
