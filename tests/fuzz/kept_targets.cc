#include <glog/logging.h>

#include <array>
#include <filesystem>
#include <string>

#include "app/campaign/campaign_tables.h"
#include "app/campaign/rig_row.h"
#include "app/trial/trial_run.h"
#include "diagnosis/fit/fit_memory.h"
#include "estimation/joint_records/fit_units.h"
#include "io/json_text.h"
#include "io/results/trial_json.h"
#include "io/results/trial_sheet.h"
#include "tests/fuzz/target.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

// The units of fit.state and diagnosis.state. What is believed is kept again as it was.
void Fits(std::string_view input) {
  const std::string bytes(input);
  if (const auto fit = PointFitOf(bytes)) CHECK(PointFitBytes(*fit) == bytes);
  std::vector<CutRecord> records(2);
  for (CutRecord& record : records) {
    record.acoustic_count = 3;
    record.flame_count = 2;
  }
  if (const auto fit = FromBytes(bytes, records, BaseEffect())) CHECK(ToBytes(*fit) == bytes);
}

// A row of campaign.state, and the results of a rig of which a row is made.
void Rows(std::string_view input) {
  CampaignSpec spec;
  spec.commands = CampaignCommands();
  const CampaignRigs rigs{{"seed", "model.modes"}, {{.name = "rig1"}}};
  const auto row = ParseJsonOrNone<nlohmann::ordered_json>(input);
  RigRows rows;
  if (IsRigRow(nlohmann::json(row), rigs)) rows.push_back(row);
  const fs::path folder = InputFile(input).parent_path();
  for (const std::string& command : spec.commands) {
    Answered([&] {
      nlohmann::ordered_json made = {{"rig", "rig1"},
                                     {"settings", {"1", "2"}},
                                     {"status", nlohmann::json::object()},
                                     {"error", ""},
                                     {"values", nlohmann::json::object()},
                                     {"points", nlohmann::json::array()}};
      const fs::path file = folder / ResultFile(command);
      fs::copy_file(folder / "input", file, fs::copy_options::overwrite_existing);
      HarvestResults(command, folder, made);
      CHECK(IsRigRow(nlohmann::json(made), rigs));
      rows.push_back(made);
    });
  }
  CHECK(!CampaignCsv(spec, rigs, rows).empty());
  CHECK(!CampaignPointsCsv(rows).empty());
  CHECK(CampaignJson(spec, rigs, rows).is_object());
}

// What a trial reads of itself to say what has changed, and to score.
void Trial(std::string_view input) {
  constexpr std::array<std::string_view, 5> kFiles = {"seal.json", "log.jsonl", "key/key.json",
                                                      "diagnoses/case001/diagnosis.json",
                                                      "diagnoses/case002/diagnosis.json"};
  const fs::path root = ScratchFolder() / "trial";
  WriteFiles(root, kFiles, input);
  const TrialFolder folder{root, root};
  const TrialLog log(folder.Log());
  for (const std::string& change : FindChanges(folder, log)) CHECK(!change.empty());
  Answered([&] {
    const ScoredTrial scored = ScoreTrial(folder, log);
    CHECK(!TrialCsv(scored.cases).empty());
    CHECK(!TrialSheet(scored.sheet, scored.command, "").empty());
    CHECK(!TrialJson(scored.sheet, {}).empty());
  });
}

}  // namespace

std::vector<FuzzTarget> KeptTargets() { return {{"fits", Fits}, {"rows", Rows}, {"trial", Trial}}; }

}  // namespace howl
