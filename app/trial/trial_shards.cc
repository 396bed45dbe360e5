#include "app/trial/trial_shards.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "app/files/digest.h"
#include "app/process/child_process.h"
#include "app/trial/trial_seal.h"
#include "io/json_fields.h"
#include "io/json_text.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSeal = "seal#";
constexpr std::string_view kKey = "key#";
constexpr std::string_view kLog = "log#";
constexpr std::string_view kDiagnosis = "diagnosis#";

std::string KeyOf(std::string_view kind, const std::string& name) {
  return std::string(kind) + name;
}

std::string Required(const Units& units, const std::string& key, const fs::path& folder) {
  const auto found = units.find(key);
  if (found == units.end()) {
    throw UserError(folder.string(), 0, key, "is not in the shards, expected it: run them again");
  }
  return found->second;
}

// The cases that have a diagnosis; a name that is a path would be written elsewhere.
std::vector<std::string> CaseNames(const Units& units, const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& [key, bytes] : units) {
    if (!key.starts_with(kDiagnosis)) continue;
    names.push_back(key.substr(kDiagnosis.size()));
    if (IsCaseName(names.back())) continue;
    throw UserError(folder.string(), 0, key,
                    "names no case of a trial: remove its shard and run it again");
  }
  return names;
}

// The names of the shards, each of which has a seal.
std::vector<std::string> ShardNames(const Units& units) {
  std::vector<std::string> names;
  for (const auto& [key, bytes] : units) {
    if (key.starts_with(kSeal)) names.push_back(key.substr(kSeal.size()));
  }
  return names;
}

void AddCases(const TrialRequest& request, const std::string& name, const Units& units,
              const fs::path& folder, SealedCases& cases) {
  const std::string sealed_key = Required(units, KeyOf(kKey, name), folder);
  const std::string seal_text = Required(units, KeyOf(kSeal, name), folder);
  const nlohmann::json seal = ParseJsonOrNone<nlohmann::json>(seal_text);
  const std::optional<std::string> key = OpenText(sealed_key, request.Passphrase());
  if (!key || !seal.is_object() || TextAt(seal, "key_sha256") != Sha256(*key)) {
    throw UserError(folder.string(), 0, KeyOf(kKey, name),
                    "is not the key that its shard sealed: remove the shard and run it again");
  }
  const nlohmann::json withheld = nlohmann::json::parse(*key).at("cases");
  for (const auto& [one, effects] : withheld.items()) cases.withheld[one] = effects;
  for (const auto& [one, sha256] : seal.at("cases").items()) {
    cases.sha256[one] = sha256.get<std::string>();
  }
}

// The diagnoses' entries of all logs, as they were made one after another.
std::vector<nlohmann::json> DiagnosedEntries(const std::vector<TrialLog>& logs) {
  std::vector<nlohmann::json> entries;
  for (const TrialLog& log : logs) {
    for (nlohmann::json entry : log.entries()) {
      if (TextAt(entry, "event") != "diagnosed") continue;
      entry.erase("previous");
      entries.push_back(std::move(entry));
    }
  }
  std::ranges::stable_sort(entries, {}, [](const nlohmann::json& entry) {
    return std::pair(TextAt(entry, "at"), TextAt(entry, "case"));
  });
  return entries;
}

}  // namespace

std::string TrialInputsSha256(const TrialRequest& request) {
  const fs::path rig = ProgramFolder() / "howl_rig";
  return Sha256(request.Passphrase() + "\n" + Sha256OfFile(rig).value_or(""));
}

TrialFolder FolderOfShard(const fs::path& out, const Shard& shard) {
  return {out, ShardPartPath(out, "trial", shard)};
}

Units UnitsOfShard(const TrialFolder& folder, const Shard& shard, const TrialLog& log) {
  Units units;
  units[KeyOf(kSeal, shard.Name())] = ReadWholeFile(folder.Seal()).value_or("");
  units[KeyOf(kKey, shard.Name())] = ReadWholeFile(folder.SealedKey()).value_or("");
  units[KeyOf(kLog, shard.Name())] = ReadWholeFile(folder.Log()).value_or("");
  for (const nlohmann::json& entry : log.entries()) {
    if (TextAt(entry, "event") != "diagnosed" || NumberAt(entry, "status", -1.0) != 0) continue;
    const std::string name = TextAt(entry, "case");
    units[KeyOf(kDiagnosis, name)] = ReadWholeFile(folder.Diagnosis(name)).value_or("");
  }
  return units;
}

void AdoptTrialShards(const Options& options, const Units& units) {
  const TrialFolder folder{options.out, options.out};
  if (fs::exists(folder.Log())) return;  // merged before; howl trial says what has changed since
  const TrialRequest request = MakeTrialRequest(options);
  const fs::path shards = ShardFolder(options.out);
  SealedCases cases;
  std::vector<TrialLog> logs;
  nlohmann::json seals = nlohmann::json::array();
  for (const std::string& name : ShardNames(units)) {
    AddCases(request, name, units, shards, cases);
    logs.push_back(TrialLog::Parse(Required(units, KeyOf(kLog, name), shards)));
    const std::optional<nlohmann::json> sealed = logs.back().Find("sealed");
    if (logs.back().broken_line() > 0 || !sealed) {
      throw UserError(shards.string(), 0, KeyOf(kLog, name),
                      "is broken, expected its shard's log: remove the shard and run it again");
    }
    seals.push_back({{"shard", name},
                     {"at", TextAt(*sealed, "at")},
                     {"seal_sha256", TextAt(*sealed, "seal_sha256")}});
  }
  for (const std::string& name : CaseNames(units, shards)) {
    RemoveUnpublished(folder.Diagnosis(name).parent_path());
    WriteWholeFile(folder.Diagnosis(name), units.at(KeyOf(kDiagnosis, name)));
  }
  const std::string seal_sha256 = WriteSeal(folder, request, cases);
  // The log comes last and at once: a merge that was stopped before it begins anew.
  const fs::path unfinished = folder.Log().string() + ".part";
  fs::remove(unfinished);
  TrialLog log(unfinished);
  log.Append(
      {{"event", "sealed"}, {"at", TimeStamp()}, {"seal_sha256", seal_sha256}, {"shards", seals}});
  for (const nlohmann::json& entry : DiagnosedEntries(logs)) log.Append(entry);
  fs::rename(unfinished, folder.Log());
}

}  // namespace howl
