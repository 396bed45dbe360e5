// The fits that a search for a budget compares: each begins from the present structure with one
// item more.
#ifndef HOWL_DIAGNOSIS_BUDGET_ITEM_TRIALS_H_
#define HOWL_DIAGNOSIS_BUDGET_ITEM_TRIALS_H_

#include <optional>
#include <vector>

#include "diagnosis/budget/held_out.h"
#include "diagnosis/budget/items/budget_item.h"

namespace howl {

// The most likely fit from here. A model error and the noise compete for what is left over, and
// there may be two maxima: where the error is large, a second fit begins with little of it.
StructureFit Converged(const std::vector<JointBand>& bands, StructureFit from);

struct ItemTrial {
  BudgetItem item;  // with the form that was best, and its parameters
  StructureFit fit;
};

// A part of the records, on which an item's starts are compared at a quarter of the cost: the first
// half of every second operating point's, or of all where there are few.
struct Screen {
  std::vector<std::size_t> points;
  std::vector<JointBand> bands;
  double log_posterior = 0.0;  // of the structure without a further item
};
Screen MakeScreen(const BudgetRecords& records, const StructureFit& from);

// No value where the item gains nothing on the screen from any start.
std::optional<ItemTrial> TryItem(const BudgetRecords& records, const Screen& screen,
                                 const StructureFit& from, const BudgetItem& item);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_ITEM_TRIALS_H_
