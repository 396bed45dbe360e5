// What a diagnosis of loops says in the end (loop_budget.h has the rule), from what its search has
// found and its budget.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_VERDICT_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_VERDICT_H_

#include "diagnosis/loop_budget/loop_budget.h"
#include "diagnosis/loop_budget/search/loop_search.h"

namespace howl {

// Sets all of `out->diagnosis` but its budget, which is there, as are the lines' errors.
void TakeVerdict(const LoopFound& found, LoopDiagnosis* out);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_VERDICT_H_
