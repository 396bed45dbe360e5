// What an instrument of q would gain, with the value of its parameter that all operating points
// share: the profile of the evidence over that value, all else of each point fitted anew.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_INSTRUMENT_TRIAL_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_INSTRUMENT_TRIAL_H_

#include <string>

#include "diagnosis/fit/estimated_parameter.h"
#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

// The gain, above `standing` (loop_trial.h), is paid for by Laplace's evidence of the parameter,
// whose prior is even over its range.
LoopTrial TryInstrument(const LoopRecords& records, const LoopFit& from, double standing,
                        const LoopItem& item, const std::string& key,
                        const LoopBudgetOptions& options);

// Of items of any kind: those that are no instruments first.
std::vector<LoopTrial> TryAll(const LoopRecords& records, const LoopFit& from, double standing,
                              const std::vector<LoopItem>& items, const std::string& key,
                              const LoopBudgetOptions& options);

// A fit to all points together leads to another value of the parameter than each point by itself
// did, and that to another fit: both in turn, until the value stands or the records are foretold no
// better.
LoopFit Refined(const LoopRecords& records, LoopFit fit, const LoopItem& item,
                const std::string& key, const LoopBudgetOptions& options);

// A trial's loop, fitted to all points together from these starts to the best that a search of each
// point finds; an instrument Refined.
LoopFit FitTrial(const LoopRecords& records, const LoopTrial& trial, const StartRows& starts,
                 const std::string& key, const LoopBudgetOptions& options);

// Of an instrument that the fit has, with the 95 % interval of its profile.
EstimatedParameter EstimateInstrument(const LoopRecords& records, const LoopFit& fit,
                                      const LoopItem& item, const std::string& key,
                                      const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_INSTRUMENT_TRIAL_H_
