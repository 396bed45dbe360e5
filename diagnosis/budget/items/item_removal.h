// A structure with one of its items taken away.
#ifndef HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_REMOVAL_H_
#define HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_REMOVAL_H_

#include <vector>

#include "diagnosis/budget/items/budget_item.h"

namespace howl {

// Where an effect stands among the structure's, and its first parameter among theirs.
struct EffectPlace {
  std::size_t number = 0;
  std::size_t first_value = 0;
};
EffectPlace PlaceOf(const StructureFit& fit, const BudgetItem& item);

// `from` without the item, the others kept: `items` are those that `from` has, in their order.
StructureFit Without(const StructureFit& from, const std::vector<BudgetItem>& items,
                     std::size_t which);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_REMOVAL_H_
