// diagnosis.json, schema howl.diagnosis/1: the results of `howl diagnose`.
#ifndef HOWL_IO_RESULTS_DIAGNOSIS_JSON_H_
#define HOWL_IO_RESULTS_DIAGNOSIS_JSON_H_

#include <nlohmann/json.hpp>
#include <string_view>

#include "diagnosis/table/table_diagnosis.h"
#include "diagnosis/verdict/diagnosis_result.h"

namespace howl {

std::string_view VerdictKindName(VerdictKind kind);

nlohmann::ordered_json DiagnosisJson(const Diagnosis& diagnosis);

// The same schema for a diagnosis from a table: without a gap (null), with `table`.
nlohmann::ordered_json TableDiagnosisJson(const TableDiagnosis& table);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_DIAGNOSIS_JSON_H_
