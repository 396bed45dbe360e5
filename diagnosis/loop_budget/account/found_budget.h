// The account of what a search has found: each item with what it takes off the gap, what is lost
// without it, its values and its place; what was given; and what is left.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_FOUND_BUDGET_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_FOUND_BUDGET_H_

#include <cstddef>

#include "diagnosis/loop_budget/search/loop_search.h"
#include "diagnosis/verdict/budget.h"

namespace howl {

// Operating points whose record is foretold better with than without.
std::size_t PointsBetter(const LoopFit& with, const LoopFit& without);

// Without what the samples show, and without bounds of what was not found.
Budget BudgetOf(const LoopRecords& records, const LoopFound& found,
                const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_FOUND_BUDGET_H_
