// What the samples of a rig show before any loop is fitted to them (estimation/health): effects of
// the catalogue that need no likelihood.
//
//   p_clipping, q_clipping   a signal stands at the end of its range
//   quantisation             p has a few levels
//
// A loop that is fitted to a clipped signal speaks of the clipping, whatever is added to it, so
// that nothing else is looked for beside it. What few levels add to p is noise, which every loop
// has.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_SAMPLE_FACTS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_SAMPLE_FACTS_H_

#include <vector>

#include "diagnosis/verdict/budget.h"
#include "estimation/joint_records/loop_record.h"

namespace howl {

// Of what more than half of the records show; values are means over those that do.
std::vector<SampleFact> SampleFactsOf(const std::vector<LoopRecord>& records);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_SAMPLE_FACTS_H_
