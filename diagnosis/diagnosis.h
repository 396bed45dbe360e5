// The gap between model and rig: how wide it is, where it lies, which effect causes it, and how far
// that effect shrinks it.
//
// Gap: for each experiment and cut the mean of |E|^2 / V less one, V being the noise (sensor noise
// of cut A without a model; combustion noise of cut B by the best fit); the root of the mean of its
// positive parts. 0: the residuals are noise. Held out: tau and an effect's parameters come from
// the other experiments.
//
// Verdict: `none` while neither an effect nor free slack gains more log-likelihood than noise
// gives; `unknown` if the gain that free slack still has after the best effect is not small against
// the effect's own gain; else the best effect, with those that come close to it.
#ifndef HOWL_DIAGNOSIS_DIAGNOSIS_H_
#define HOWL_DIAGNOSIS_DIAGNOSIS_H_

#include <vector>

#include "diagnosis/records/cut_record.h"
#include "diagnosis/search/diagnosis_options.h"
#include "diagnosis/verdict/diagnosis_result.h"

namespace howl {

// The diagnosis is the same for any number of threads; nothing in it is random but the bootstrap.
Diagnosis Diagnose(const std::vector<DiagnosisExperiment>& experiments,
                   const DiagnosisOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_DIAGNOSIS_H_
