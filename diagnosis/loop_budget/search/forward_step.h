// The forward half of the search for a budget (loop_search.h): the item that a loop lacks most.
//
// A trial of an item (loop_trial.h) costs less than a fit of all points together, and instruments'
// cost most. What an item gains falls, as a rule, as others come in: one that gained less when it
// was last tried than others do now is not tried again before these have been found not to pay
// (Minoux 1978, of sums whose terms gain less the more there are). An item is refused only after a
// trial beside all that has come in.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_FORWARD_STEP_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_FORWARD_STEP_H_

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

struct LoopRival {
  LoopItem item;
  double behind = 0.0;  // nats, of the item that came in
};

struct LoopStep {
  LoopItem item;
  double least = 0.0;  // nats that it had to gain, among so many, beside nothing
  double price = 0.0;  // and for values that all points share (LoopTrial)
  // What was fitted beside it and gained too, or would have gained as much (WithinReach).
  std::vector<LoopRival> rivals;
  std::size_t others = 0;  // that stood when it came
  LoopFit after = {};
  std::vector<std::string> equals = {};  // of the rivals, within these odds in the end
};

class ForwardSearch {
 public:
  // base_density: of the loop without any item, from which what others gained is counted.
  ForwardSearch(const LoopRecords& records, const LoopForm& base, double base_density,
                const LoopBudgetOptions& options)
      : records_(records), base_(base), base_density_(base_density), options_(options) {}

  // No value where nothing pays any more. Units are kept under `prefix`.
  std::optional<LoopStep> Next(const LoopFit& from, const std::vector<LoopStep>& steps,
                               const std::string& prefix);

  // What each item gained, by its ID and in its best form, in trials of the first step.
  const std::map<std::string, double>& alone() const { return alone_; }

 private:
  std::vector<LoopTrial> Try(const LoopFit& from, double standing,
                             const std::vector<LoopItem>& items, const std::string& key);
  // The best of these trials that pays, with `offered` items in all; those whose items are in
  // `fitted` have been found not to, and the next ones are added.
  std::optional<LoopStep> BestOf(const std::vector<LoopTrial>& trials, const LoopFit& from,
                                 std::size_t offered, const std::string& key,
                                 std::vector<std::string>* fitted) const;
  double LastGain(const LoopItem& item) const;

  const LoopRecords& records_;
  const LoopForm& base_;
  double base_density_;
  const LoopBudgetOptions& options_;
  std::map<std::string, double> last_gain_;  // nats, of a trial, by the item's key
  std::map<std::string, double> alone_;
  bool first_step_ = true;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_SEARCH_FORWARD_STEP_H_
