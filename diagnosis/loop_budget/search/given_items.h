// Items that a search for a budget begins with, as a user names them who knows of them, or has them
// from an earlier diagnosis: they are of the base, and nothing takes them away.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_GIVEN_ITEMS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_GIVEN_ITEMS_H_

#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

struct GivenLoop {
  LoopFit fit;
  std::vector<LoopItem> items;  // in the forms that were taken
};

// `fit`, of `base`, with options.given one after the other, whether they pay or not. Of the forms
// that an id has the one is taken that gains most; an id that the loop has already changes nothing.
GivenLoop WithGiven(const LoopRecords& records, const LoopForm& base, LoopFit fit,
                    const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_GIVEN_ITEMS_H_
