// Which further measurement would best tell the remaining candidates apart.
#ifndef HOWL_DIAGNOSIS_VERDICT_ADVICE_H_
#define HOWL_DIAGNOSIS_VERDICT_ADVICE_H_

#include <string>

#include "diagnosis/verdict/diagnosis_result.h"

namespace howl {

// model_free: the effect was detected in the samples themselves, without a likelihood.
std::string Advice(const Diagnosis& diagnosis, bool model_free);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_VERDICT_ADVICE_H_
