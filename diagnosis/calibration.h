// Probabilities as blind trials bear them out. Likelihoods know nothing of what neither the model
// nor the catalogue has, and are too sure; how often a verdict of each kind was wrong on rigs of
// another simulator (results/trial) is the doubt that is taken off it and spread over the rest.
#ifndef HOWL_DIAGNOSIS_CALIBRATION_H_
#define HOWL_DIAGNOSIS_CALIBRATION_H_

#include "diagnosis/diagnosis.h"

namespace howl {

// model_free: the effect was detected in the samples themselves or as a spectral line. Such
// verdicts hardly err.
void Calibrate(bool model_free, Diagnosis* diagnosis);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CALIBRATION_H_
