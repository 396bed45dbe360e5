// Effects that are no transfer functions: lines, saturation, few levels, a fluctuating gain. They
// are put into the records' own samples at a trial size, and the diagnosis' own estimators say
// whether they find them.
#ifndef HOWL_DIAGNOSIS_PLAN_PLAN_SAMPLES_H_
#define HOWL_DIAGNOSIS_PLAN_PLAN_SAMPLES_H_

#include <optional>

#include "diagnosis/plan/plan.h"
#include "diagnosis/plan/plan_records.h"

namespace howl {

// The size at which the effect is found, and from which on it is told from the other of its kind.
// Nothing for a kind that a plan does not know.
std::optional<PlannedEffect> PlanInSamples(const PlanRecords& at, const Effect& effect);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLAN_SAMPLES_H_
