// How well a fitted loop foretells what it was not fitted to. Each point's loop is fitted to one
// half of its record, under the law that the other points give; the other half is then predicted
// (band_errors.h). What modes hold at the ends of a half is that half's own: it is estimated there,
// given the rest.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LOOP_HELD_OUT_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LOOP_HELD_OUT_H_

#include <string>

#include "diagnosis/held_out/held_out_score.h"
#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

// Of one point alone the prior is its own.
HeldOutScore ScoreHeldOut(const LoopRecords& records, const LoopFit& fit, const std::string& key,
                          const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LOOP_HELD_OUT_H_
