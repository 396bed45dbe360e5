// What a diagnosis of loops says in the end (loop_budget.h has the rule), from what its search has
// found and its budget.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_VERDICT_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_VERDICT_H_

#include <cstddef>
#include <string>

#include "diagnosis/loop_budget/loop_budget.h"
#include "diagnosis/loop_budget/search/loop_search.h"

namespace howl {

// In words, an effect of the catalogue that would have a value outside its bounds, of those without
// a unit: times and frequencies have the bounds of rigs of another size. Empty: there is none.
std::string ValueThatCannotBe(const Budget& budget);

// In words, why a budget's loop is not the rig's. `named` causes would be named. Empty: it may be.
std::string WhyUnknown(const Budget& budget, bool errs_at_lines, std::ptrdiff_t named);

// Sets all of `out->diagnosis` but its budget, which is there, as are the lines' errors.
void TakeVerdict(const LoopFound& found, LoopDiagnosis* out);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_VERDICT_H_
