// The steps of a blind trial. Each can be killed at any point; the same command then goes on.
#ifndef HOWL_APP_TRIAL_TRIAL_RUN_H_
#define HOWL_APP_TRIAL_TRIAL_RUN_H_

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "app/jobs/shard.h"
#include "app/trial/trial_folder.h"
#include "app/trial/trial_rig.h"
#include "trial/score.h"

namespace howl {

// All that determines the cases, and from which the key's passphrase is made.
struct TrialRequest {
  RigTemplate rig_template;
  TrialOptions options;
  std::string config_sha256;
  std::string command;                        // what reproduces the trial
  std::optional<Shard> shard = std::nullopt;  // which of the cases; all without it
  std::string Passphrase() const;
};
TrialRequest MakeTrialRequest(const Options& options);

// Makes the cases, seals key and cases. `progress` as in RunDiagnoses.
using Progress = std::function<void(std::size_t done, std::size_t total)>;
void MakeCases(const TrialFolder& folder, const TrialRequest& request, int threads,
               const Progress& progress, TrialLog& log);

// Runs the diagnoses that the log has not, each in a process of its own. Throws Interrupted.
void RunDiagnoses(const TrialFolder& folder, int threads, const Progress& progress, TrialLog& log);

// Decrypts the key; empty where the request is not the one that sealed it.
std::string DecipherKey(const TrialFolder& folder, const TrialRequest& request);

// Writes key.json and logs the opening.
void OpenKey(const TrialFolder& folder, const std::string& key, TrialLog& log);

struct ScoredTrial {
  std::string command;  // both as the key has them
  nlohmann::json seed;
  std::vector<CaseOutcome> cases;
  std::vector<RigEffect> effects;
  ScoreSheet sheet;
};
// Throws UserError where the key or a diagnosis is damaged.
ScoredTrial ScoreTrial(const TrialFolder& folder, const TrialLog& log);

// trial.json, trial.csv and sheet.md, and their entry in the log.
void WriteScores(const TrialFolder& folder, const ScoredTrial& trial, TrialLog& log);

}  // namespace howl

#endif  // HOWL_APP_TRIAL_TRIAL_RUN_H_
