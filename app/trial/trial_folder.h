// A trial's folder:
//
//   cases/NAME/         the input of the diagnosis: config.yaml and data/
//   key/key.sealed      the withheld effects, encrypted; nobody can read them without the seed
//   seal.json           SHA-256 of the key, of its sealed form, and of every case; it is written,
//                       and its own SHA-256 logged, before the first diagnosis starts
//   diagnoses/NAME/     diagnosis.json
//   log.jsonl           sealed, each diagnosis with its SHA-256, opened, scored (trial_log.h)
//   key/key.json        the key, once it has been opened
//   trial.json, trial.csv, sheet.md
//
// Several processes, each a shard of the trial (app/jobs/shard.h), work on the same cases/ and
// diagnoses/; each has key/, seal.json and log.jsonl of its own share in a folder of its own.
#ifndef HOWL_APP_TRIAL_TRIAL_FOLDER_H_
#define HOWL_APP_TRIAL_TRIAL_FOLDER_H_

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/trial/trial_log.h"

namespace howl {

struct TrialFolder {
  std::filesystem::path root;
  std::filesystem::path books;  // key, seal and log: the root, but for a shard

  std::filesystem::path CaseFolder(const std::string& name) const { return root / "cases" / name; }
  std::filesystem::path Diagnosis(const std::string& name) const {
    return root / "diagnoses" / name / "diagnosis.json";
  }
  std::filesystem::path SealedKey() const { return books / "key" / "key.sealed"; }
  std::filesystem::path OpenKey() const { return books / "key" / "key.json"; }
  std::filesystem::path Seal() const { return books / "seal.json"; }
  std::filesystem::path Log() const { return books / "log.jsonl"; }
};

// What a run that was killed left unpublished in the trial's own folders, which the lock of the
// output folder does not see to; nobody else may be at work on these books.
void RemoveUnpublished(const TrialFolder& folder);

// Whether it is a name as cases have, and no path: a case's folder is removed and made anew.
bool IsCaseName(std::string_view name);

// A hash over the names, sizes and contents of all files of a folder.
std::string Sha256OfFolder(const std::filesystem::path& folder);

// A line for each file that is no longer as it was sealed, diagnosed, opened or scored.
std::vector<std::string> FindChanges(const TrialFolder& folder, const TrialLog& log);

}  // namespace howl

#endif  // HOWL_APP_TRIAL_TRIAL_FOLDER_H_
