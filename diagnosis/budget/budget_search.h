// The search for a budget (budget.h): forward, one item at a time, then backward. Inner workings:
// item_trials.h fits an item; the account of what each item is worth is budget.cc's.
#ifndef HOWL_DIAGNOSIS_BUDGET_BUDGET_SEARCH_H_
#define HOWL_DIAGNOSIS_BUDGET_BUDGET_SEARCH_H_

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/budget/budget.h"
#include "diagnosis/budget/held_out.h"
#include "diagnosis/budget/item_trials.h"

namespace howl {

struct BudgetStep {
  BudgetItem item;
  std::vector<std::string> equals;
  HeldOutScore after;
};

// A structure with one of its items taken away and the rest fitted anew.
struct BudgetLoss {
  double nats = 0.0;  // of evidence
  HeldOutScore score;
};

struct BudgetFound {
  StructureFit fit;
  HeldOutScore base;
  HeldOutScore all;                // of `fit`
  std::vector<BudgetStep> steps;   // of the items that stayed
  std::vector<BudgetLoss> losses;  // one a step
};

// No value if it was stopped.
std::optional<BudgetFound> SearchBudget(BudgetRecords* records, const BudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_BUDGET_SEARCH_H_
