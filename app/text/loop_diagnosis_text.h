// The answer of howl diagnose about a loop that records show (Config::record_loop).
#ifndef HOWL_APP_TEXT_LOOP_DIAGNOSIS_TEXT_H_
#define HOWL_APP_TEXT_LOOP_DIAGNOSIS_TEXT_H_

#include <string>

#include "diagnosis/loop_budget/loop_budget.h"

namespace howl {

std::string LoopDiagnosisText(const LoopDiagnosis& diagnosis);

}  // namespace howl

#endif  // HOWL_APP_TEXT_LOOP_DIAGNOSIS_TEXT_H_
