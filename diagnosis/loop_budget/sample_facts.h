// What the samples of a rig show before any loop is fitted to them (estimation/health): effects of
// the catalogue that need no likelihood.
//
//   p_clipping, q_clipping   a signal stands at the end of its range; p's density ends there in
//                            edges (samples/sample_limits.h)
//   quantisation             p has a few levels, or up to 256 whose steps are its noise
//                            (fine_steps.h)
//   p_dropouts, q_dropouts   a signal stands still for longer than by chance
//   mains_hum                either signal has a line at one to six times the mains' frequency
//                            below the band of the fits (samples/hum_below_band.h)
//
// A loop that is fitted to clipped samples speaks of what was done to them, whatever is added to
// it: what clipping and coarse steps add goes with the signal, and no source of noise does. So
// nothing else is looked for beside a clipped q or coarse steps, unless they are withheld as an
// item is. What p lost at the ends of its range is drawn anew (clipped_samples.h), what a signal
// lost while it stood still is filled (stuck_samples.h), fine steps alone add white noise, and hum
// below the band is in no fit: they leave the rest to be found.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_SAMPLE_FACTS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_SAMPLE_FACTS_H_

#include <string>
#include <vector>

#include "diagnosis/verdict/budget.h"
#include "estimation/joint_records/loop_record.h"

namespace howl {

std::vector<std::string> SampleFactIds();

// Of what more than half of the records show, without those that are withheld; values are means
// over the records that do.
std::vector<SampleFact> SampleFactsOf(const std::vector<LoopRecord>& records,
                                      const std::vector<std::string>& withheld = {});

// Whether all of these leave the rest to be found.
bool RestCanBeFound(const std::vector<SampleFact>& facts);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_SAMPLE_FACTS_H_
