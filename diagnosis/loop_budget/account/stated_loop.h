// What of a loop that was found a config can state: its model, and what of the records is its
// instruments' (record_spec.h), which are taken out before a loop is fitted.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_STATED_LOOP_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_STATED_LOOP_H_

#include <string>

#include "diagnosis/loop_budget/forms/loop_item.h"
#include "diagnosis/loop_budget/forms/loop_records.h"
#include "diagnosis/loop_budget/forms/shared_effect.h"
#include "diagnosis/loop_budget/search/loop_search.h"
#include "diagnosis/verdict/budget.h"

namespace howl {

// To six digits.
std::string ShortNumber(double value);

// Of one effect of the catalogue: a formula of s in rad/s; empty where it is no response of an
// instrument, or one that a user has declared.
std::string ResponseFormula(const SharedEffect& shared);

// Whether a fit of whole records takes what the item says.
bool IsStated(const LoopItem& item);

// With the values that the budget's items have.
StatedLoop StatedLoopOf(const LoopRecords& records, const LoopFound& found, const Budget& budget);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_STATED_LOOP_H_
