// Other items in the places of those that a search has come to (loop_search.h).
//
// Of two that do nearly the same, that which gains more beside a poor noise need not be the right
// one, and keeps the other out from then on. So once all else stands each item makes room for its
// rivals of the step in which it came.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_EXCHANGE_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_EXCHANGE_H_

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/search/forward_step.h"

namespace howl {

// A search's best loop, the steps that led there, and of each that loop without its item.
struct LoopStanding {
  LoopFit best;
  std::vector<LoopStep> steps;
  std::vector<LoopFit> without;
};

// The rival with which the records are foretold best, better than as things stand, in the place of
// its item: its step is the last one. No value where none is. Sets the steps' equals.
std::optional<LoopStanding> BestExchange(const LoopRecords& records, const LoopForm& base,
                                         const std::string& key, const LoopBudgetOptions& options,
                                         LoopStanding* now);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_EXCHANGE_H_
