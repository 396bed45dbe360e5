// What the operating points say of one another's new values, where each was fitted by itself under
// wide priors of what an item brings: values that agree are foretold by the others', and are worth
// more than the same number of values that do not. Six points' delays that follow the amplitude
// alike, each at two of its deviations, are 12 nats that wide priors alone take for less than none.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LAW_OF_TRIAL_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LAW_OF_TRIAL_H_

#include <vector>

#include "diagnosis/loop_budget/trials/loop_starts.h"

namespace howl {

// Nats that the evidence of all fits, of a trial (loop_trial.h), gains where parameters that `from`
// has not are under the law that the other points give (parameter_law.h) and not under wide priors:
// to second order about these. At least two points.
double GainedByLaw(const LoopRecords& records, const LoopFit& from, const LoopForm& with,
                   const std::vector<PointFit>& fits, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LAW_OF_TRIAL_H_
