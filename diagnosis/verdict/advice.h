// Which further measurement would best tell the remaining candidates apart.
#ifndef HOWL_DIAGNOSIS_VERDICT_ADVICE_H_
#define HOWL_DIAGNOSIS_VERDICT_ADVICE_H_

#include <string>

#include "diagnosis/verdict/diagnosis_result.h"

namespace howl {

// Where samples are clipped or have few levels.
inline constexpr const char* kRecordAgain =
    "record again, within the converter's range and with finer steps: whatever is fitted to such "
    "samples speaks of what was done to them";

// model_free: the effect was detected in the samples themselves, without a likelihood.
std::string Advice(const Diagnosis& diagnosis, bool model_free);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_VERDICT_ADVICE_H_
