// Calibrates probabilities by blind trials. Likelihoods know nothing of what neither the model nor
// the catalogue has, and are too sure. The share of wrong verdicts of each kind on rigs of another
// simulator (results/trial) is the doubt that is subtracted from such a verdict and spread over the
// rest.
#ifndef HOWL_DIAGNOSIS_VERDICT_CALIBRATION_H_
#define HOWL_DIAGNOSIS_VERDICT_CALIBRATION_H_

#include "diagnosis/verdict/diagnosis_result.h"

namespace howl {

// How often a verdict of this kind is wrong: of the search for one cause, and of the budget.
// model_free: the effect was detected in the samples themselves or as a spectral line. Such
// verdicts hardly err.
double DoubtOfOneCause(VerdictKind kind, bool model_free);
double DoubtOfBudget(VerdictKind kind);

void Calibrate(double doubt, Diagnosis* diagnosis);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_VERDICT_CALIBRATION_H_
