// trial.json (schema "howl.trial/1") and trial.csv, a row for each case; and what a trial reads of
// diagnosis.json.
#ifndef HOWL_IO_RESULTS_TRIAL_JSON_H_
#define HOWL_IO_RESULTS_TRIAL_JSON_H_

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "trial/score.h"

namespace howl {

// Fills in what the diagnosis said; throws nlohmann::json::exception where the tree is none of
// diagnose's.
void ReadDiagnosis(const nlohmann::json& diagnosis, CaseOutcome* one);

nlohmann::ordered_json TrialJson(const ScoreSheet& sheet, const nlohmann::ordered_json& about);

std::string TrialCsv(std::span<const CaseOutcome> cases);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_TRIAL_JSON_H_
