#include <cmath>

#include "app/files/digest.h"
#include "app/trial/trial_run.h"
#include "io/json_fields.h"
#include "io/result_files.h"
#include "io/results/trial_json.h"
#include "io/results/trial_sheet.h"
#include "io/whole_file.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

std::vector<RigEffect> ReadEffects(const nlohmann::json& key) {
  std::vector<RigEffect> effects;
  for (const nlohmann::json& each : key.at("rig_effects")) {
    effects.push_back({each.at("id").get<std::string>(), each.at("block").get<std::string>(),
                       each.at("in_catalogue").get<bool>(), each.at("size_name").get<std::string>(),
                       each.at("sizes").get<std::array<double, 3>>()});
  }
  return effects;
}

std::vector<WithheldEffect> ReadWithheld(const nlohmann::json& rig) {
  std::vector<WithheldEffect> withheld;
  for (const nlohmann::json& each : rig.at("effects")) {
    withheld.push_back({each.at("effect").get<std::string>(), each.at("block").get<std::string>(),
                        each.at("in_catalogue").get<bool>(), each.at("severity").get<double>()});
  }
  return withheld;
}

}  // namespace

ScoredTrial ScoreTrial(const TrialFolder& folder, const TrialLog& log) {
  ScoredTrial trial;
  trial.key = nlohmann::json::parse(ReadWholeFile(folder.OpenKey()).value_or(""));
  trial.effects = ReadEffects(trial.key);
  std::map<std::string, double> seconds;
  for (const nlohmann::json& entry : log.entries()) {
    if (TextAt(entry, "event") == "diagnosed") {
      seconds[TextAt(entry, "case")] = NumberAt(entry, "seconds", std::nan(""));
    }
  }
  for (const auto& [name, rig] : trial.key.at("cases").items()) {
    CaseOutcome one;
    one.name = name;
    one.withheld = ReadWithheld(rig);
    one.seconds = seconds.contains(name) ? seconds[name] : std::nan("");
    if (const auto text = ReadWholeFile(folder.Diagnosis(name))) {
      ReadDiagnosis(nlohmann::json::parse(*text), &one);
    }
    trial.cases.push_back(std::move(one));
  }
  trial.sheet = Score(trial.cases, trial.effects);
  return trial;
}

void WriteScores(const TrialFolder& folder, const ScoredTrial& trial, TrialLog& log) {
  const std::string seal = TextAt(*log.Find("sealed"), "seal_sha256");
  const auto command = trial.key.at("command").get<std::string>();
  const Json about = {{"command", command}, {"seed", trial.key.at("seed")}, {"seal_sha256", seal}};
  const std::map<std::string, std::string> files = {
      {"trial.json", TrialJson(trial.sheet, about).dump(2) + "\n"},
      {kTrialCsv, TrialCsv(trial.cases)},
      {"sheet.md", TrialSheet(trial.sheet, command, seal)}};
  Json hashes = Json::object();
  for (const auto& [name, text] : files) {
    WriteWholeFile(folder.root / name, text);
    hashes[name] = Sha256(text);
  }
  log.Append({{"event", "scored"}, {"at", TimeStamp()}, {"files", hashes}});
}

}  // namespace howl
