// diagnosis.json, schema howl.diagnosis/1, of a loop that records show (Config::record_loop).
#ifndef HOWL_IO_RESULTS_LOOP_DIAGNOSIS_JSON_H_
#define HOWL_IO_RESULTS_LOOP_DIAGNOSIS_JSON_H_

#include <nlohmann/json.hpp>

#include "diagnosis/loop_budget/loop_budget.h"

namespace howl {

// As DiagnosisJson, with `base` and `best` as the keys of a config's `model`, and with
// `line_errors`: what is left at the cycle's lines.
nlohmann::ordered_json LoopDiagnosisJson(const LoopDiagnosis& found);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_LOOP_DIAGNOSIS_JSON_H_
