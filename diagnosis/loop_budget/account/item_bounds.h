// How large what was not found may still be:
//
//   { u : max l - l(u) <= z^2 / 2 },   l(u) = max over all else of ln p(records, all else | u)
//
// the interval of the likelihood ratio of 95 %, z = 1.96, which the profile of each item's value
// tells (effect_profile.h). A search that finds nothing tells a reader little without it: what lies
// within these bounds the records cannot reject.
//
// All else of each operating point is free, under wide priors: the law of the points, which the
// search compares loops by, would hold fast what an item that is not in the loop has moved at all
// of them.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_ITEM_BOUNDS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_ITEM_BOUNDS_H_

#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"
#include "diagnosis/verdict/budget.h"

namespace howl {

// Beside `best`: of shared effects with one parameter, and of changes that follow the cycle's
// amplitude or drift, each point's value being the same. Bounds are infinite where the null or the
// range of the catalogue is reached.
std::vector<ItemBound> BoundsBeside(const LoopRecords& records, const LoopFit& best,
                                    const LoopForm& base, const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_ITEM_BOUNDS_H_
