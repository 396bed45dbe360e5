// What a further item would gain, each operating point by itself: nats of its record's evidence,
// under the priors that the law of the points gives, and wide ones of what the item brings, or
// those that the points give one another where they agree on it (law_of_trial.h). A fit of all
// points together takes ten times as long, and is for those that gain most (loop_search.h).
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_TRIAL_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_TRIAL_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/loop_starts.h"
#include "estimation/joint_records/fit_units.h"

namespace howl {

// Beyond what any rig was found to need: of three measured points 15 stayed.
inline constexpr std::size_t kMostItems = 24;

struct LoopBudgetOptions {
  std::size_t starts = 12;  // of the base's fit, of each point by itself
  std::uint64_t seed = 1;
  int threads = 0;
  FitUnits* units = nullptr;
  std::vector<std::string> withheld = {};    // items that are not tried
  std::vector<std::string> given = {};       // that the base has
  std::vector<EffectPointer> declared = {};  // that are tried too (shared_effect.h)
  std::size_t most_items = kMostItems;       // that may come in before the way back
  // Whether the base's points have one delay, so that a trend of their own ones is a cause
  // (delay_trend.h).
  bool one_delay = false;
  std::function<void(std::size_t done, std::size_t total)> progress;  // in trials of a step
};

struct LoopTrial {
  LoopItem item;
  LoopForm model;
  // Nats. Of a mode that at most points is narrower than the record resolves minus infinity: the
  // records do not tell it from a tone, which is another item.
  double gain = 0.0;
  // Of that, what values which all points share cost. Densities of records that are left out do not
  // pay for them: they are fitted to all records.
  double price = 0.0;
  StartRows starts;  // one row: where each point's fit came to
};

// Nats of evidence of all points' records for `from` as trials have it: each point by itself, under
// the normal priors that the law gives. The joint fit's own is of the law's priors, whose tails are
// longer; to a trial that would be a gain of tens of nats for nothing.
double StandingEvidence(const LoopRecords& records, const LoopFit& from, const std::string& key,
                        const LoopBudgetOptions& options);

// In the order of the items. Gains are above `standing`.
std::vector<LoopTrial> TryItems(const LoopRecords& records, const LoopFit& from, double standing,
                                const std::vector<LoopItem>& items, const std::string& key,
                                const LoopBudgetOptions& options);

// How a trial fits a point's record, of which it need not know all that it gains over the log
// posterior without (odds.h).
PointFitOptions ToCompareWith(double log_posterior);

// The priors of a trial on `record`, that of point e as `with` has it: those of the law for what
// `from` has, wide ones for what is new.
PointPrior PriorOfTrial(const LoopRecords& records, const LoopFit& from, const LoopForm& with,
                        std::size_t e, const RecordSpectra& record);

// How all points are fitted together, with units under `key`.
RecordsFitOptions FitOptionsOf(const LoopBudgetOptions& options, const std::string& key);

// With what each point's record is foretold, as it was recorded.
LoopFit Scored(const LoopRecords& records, const LoopForm& model, RecordsFit fit,
               const RecordsFitOptions& options);

// All points together: to the maximum next to `starts`, which is for comparing models that are to
// be fitted again, or to the best that each point's search for others finds.
enum class MaximumTaken : std::uint8_t { kNext, kBest };
LoopFit FitLoopFrom(const LoopRecords& records, const LoopForm& model, const StartRows& starts,
                    MaximumTaken taken, const std::string& key, const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_TRIAL_H_
