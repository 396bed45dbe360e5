#include <cmath>
#include <functional>
#include <utility>

#include "app/files/digest.h"
#include "app/trial/trial_run.h"
#include "io/json_fields.h"
#include "io/json_text.h"
#include "io/result_files.h"
#include "io/results/trial_json.h"
#include "io/results/trial_sheet.h"
#include "io/user_error.h"
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

// Hands the file's JSON to `read`, which throws where a field is missing or of another type.
void ReadOf(const std::filesystem::path& path,
            const std::function<void(const nlohmann::json&)>& read) {
  try {
    read(ParseJson<nlohmann::json>(ReadWholeFile(path).value_or("")));
  } catch (const nlohmann::json::exception&) {
    throw UserError(path.string(), 0, "", "is damaged, expected it as howl trial wrote it");
  } catch (const JsonTooDeep& error) {
    throw UserError(path.string(), 0, "", error.what());
  }
}

}  // namespace

ScoredTrial ScoreTrial(const TrialFolder& folder, const TrialLog& log) {
  ScoredTrial trial;
  std::vector<std::pair<std::string, std::vector<WithheldEffect>>> cases;
  ReadOf(folder.OpenKey(), [&](const nlohmann::json& key) {
    trial.command = key.at("command").get<std::string>();
    trial.seed = key.at("seed");
    trial.effects = ReadEffects(key);
    for (const auto& [name, rig] : key.at("cases").items()) {
      cases.emplace_back(name, ReadWithheld(rig));
    }
  });
  std::map<std::string, double> seconds;
  for (const nlohmann::json& entry : log.entries()) {
    if (TextAt(entry, "event") == "diagnosed") {
      seconds[TextAt(entry, "case")] = NumberAt(entry, "seconds", std::nan(""));
    }
  }
  for (const auto& [name, withheld] : cases) {
    CaseOutcome one;
    one.name = name;
    one.withheld = withheld;
    one.seconds = seconds.contains(name) ? seconds[name] : std::nan("");
    if (std::filesystem::exists(folder.Diagnosis(name))) {
      ReadOf(folder.Diagnosis(name),
             [&](const nlohmann::json& diagnosis) { ReadDiagnosis(diagnosis, &one); });
    }
    trial.cases.push_back(std::move(one));
  }
  trial.sheet = Score(trial.cases, trial.effects);
  return trial;
}

void WriteScores(const TrialFolder& folder, const ScoredTrial& trial, TrialLog& log) {
  const std::string seal = TextAt(*log.Find("sealed"), "seal_sha256");
  const Json about = {{"command", trial.command}, {"seed", trial.seed}, {"seal_sha256", seal}};
  const std::map<std::string, std::string> files = {
      {"trial.json", TrialJson(trial.sheet, about).dump(2) + "\n"},
      {kTrialCsv, TrialCsv(trial.cases)},
      {"sheet.md", TrialSheet(trial.sheet, trial.command, seal)}};
  Json hashes = Json::object();
  for (const auto& [name, text] : files) {
    WriteWholeFile(folder.root / name, text);
    hashes[name] = Sha256(text);
  }
  log.Append({{"event", "scored"}, {"at", TimeStamp()}, {"files", hashes}});
}

}  // namespace howl
