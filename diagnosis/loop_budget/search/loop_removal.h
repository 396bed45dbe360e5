// What a search's loop loses without each of its items (loop_search.h).
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_REMOVAL_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_REMOVAL_H_

#include <cstddef>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/search/loop_exchange.h"

namespace howl {

// Sets `without` of these steps, each by itself; where it has been set the fit goes on from there.
void TakeAway(const LoopRecords& records, const LoopForm& base,
              const std::vector<std::size_t>& which, MaximumTaken taken, const std::string& key,
              const LoopBudgetOptions& options, LoopStanding* out);

std::vector<std::size_t> Others(const LoopStanding& found, const std::vector<std::size_t>& than);

// The steps that are known not to pay what they had to, that which pays least first.
// base_density: of the loop without any item.
std::vector<std::size_t> Idle(const LoopStanding& found, double base_density);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_REMOVAL_H_
