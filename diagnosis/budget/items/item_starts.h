// A structure with one item more, and where a fit of it may begin.
#ifndef HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_STARTS_H_
#define HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_STARTS_H_

#include <vector>

#include "diagnosis/budget/items/budget_item.h"

namespace howl {

// Where a fit with an effect may begin: its parameters next to their null, where it never ends
// below the structure without it; as they were fitted before; or those of the catalogue, with
// little model error, as it may have made up for the effect, and the acoustics as they are or
// searched anew.
struct EffectStart {
  EffectPointer form;
  std::vector<double> values;
  bool of_catalogue = false;
  bool new_acoustics = false;
};
std::vector<EffectStart> EffectStarts(const LoopStructure& structure, const BudgetItem& item);
StructureFit StartWith(const std::vector<JointBand>& bands, const StructureFit& from,
                       const EffectStart& start);

// Of another kind of item: fits may begin from each of these, `from` with the item added where it
// may do most.
std::vector<StructureFit> StartsWith(const std::vector<JointBand>& bands, const StructureFit& from,
                                     const BudgetItem& item);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_ITEMS_ITEM_STARTS_H_
