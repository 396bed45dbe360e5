// The search for a budget of records: forward, one item at a time, then backward, and again where
// anything went; then with items in the places of others (loop_exchange.h).
//
// The score of a model is the density of each operating point's record by the law that the other
// points give, summed (records_fit.h); of one point alone its evidence. An item comes in where it
// raises the score by more than the odds against any of so many, and goes where the score without
// it is not lower by as much; beside others it must gain what errors of their forms may leave too
// (odds.h). Noise and other causes come in the order of what they gain: what a
// poor noise leaves over passes for effects, and what a strong instrument leaves passes for noise,
// or for hum. Errors at the cycle's lines come where nothing else pays: were they there from the
// beginning, they would hide what the lines tell of the flame. What pays beside them then is looked
// for as before.
//
// The flames are driven by p without the noise that the loop which stands finds there
// (pressure_noise.h): whatever is tried beside it is driven so too.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_SEARCH_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_SEARCH_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/search/loop_exchange.h"

namespace howl {

struct LoopFound : LoopStanding {
  LoopRecords records;  // with the flames driven as `best` has it
  LoopFit base;
  std::optional<LoopFit> without_given;  // the base without items that were given, if any were
  std::vector<LoopItem> given;           // which the base has
  // `best` with errors at the cycle's lines (loop_point.h), of acoustics or of flame; `best` itself
  // where it has them.
  LoopFit with_acoustic_lines;
  LoopFit with_flame_lines;
  std::map<std::string, double> alone;  // nats (ForwardSearch::alone)
  bool looked = true;                   // for what the loop may lack
};

LoopFound SearchLoopBudget(LoopRecords records, const LoopForm& base,
                           const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_LOOP_SEARCH_H_
