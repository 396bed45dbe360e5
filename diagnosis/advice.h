// Which further measurement would best tell the remaining candidates apart.
#ifndef HOWL_DIAGNOSIS_ADVICE_H_
#define HOWL_DIAGNOSIS_ADVICE_H_

#include <string>

#include "diagnosis/diagnosis.h"

namespace howl {

std::string Advice(const Diagnosis& diagnosis);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_ADVICE_H_
