// What a shared effect (shared_effect.h) would gain: the profile of the evidence over its
// parameters, all else of each operating point fitted anew.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_SHARED_EFFECT_TRIAL_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_SHARED_EFFECT_TRIAL_H_

#include <string>
#include <vector>

#include "diagnosis/fit/estimated_parameter.h"
#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

// The gain, above `standing` (loop_trial.h), is paid for by Laplace's evidence of the parameters,
// whose priors are even over their ranges.
LoopTrial TrySharedEffect(const LoopRecords& records, const LoopFit& from, double standing,
                          const LoopItem& item, const std::string& key,
                          const LoopBudgetOptions& options);

// The likelier of a trial and of one that begins far from the effect's null (effect_profile.h).
LoopTrial TryFarFromNull(const LoopRecords& records, const LoopFit& from, double standing,
                         LoopTrial near, const std::string& key, const LoopBudgetOptions& options);

// Of items of any kind: those that are no shared effects first. What is not far behind the best
// trial is tried far from its null too.
std::vector<LoopTrial> TryAll(const LoopRecords& records, const LoopFit& from, double standing,
                              const std::vector<LoopItem>& items, const std::string& key,
                              const LoopBudgetOptions& options);

// A fit to all points together leads to other values of the parameters than each point by itself
// did, and those to another fit: both in turn, until they stand or the records are foretold no
// better.
LoopFit Refined(const LoopRecords& records, LoopFit fit, const LoopItem& item,
                const std::string& key, const LoopBudgetOptions& options);

// A trial's loop, fitted to all points together from these starts to the best that a search of each
// point finds; a shared effect Refined.
LoopFit FitTrial(const LoopRecords& records, const LoopTrial& trial, const StartRows& starts,
                 const std::string& key, const LoopBudgetOptions& options);

// Of a shared effect that the fit has, with the 95 % intervals of its profile.
std::vector<EstimatedParameter> EstimateSharedEffect(const LoopRecords& records, const LoopFit& fit,
                                                     const LoopItem& item, const std::string& key,
                                                     const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_SHARED_EFFECT_TRIAL_H_
