// The budget of loops on the cases of a trial, whose key is open:
//
//   [EFFECTS=none,q_sensor_lowpass] loop_trial_study TRIAL_FOLDER [CASE ...]
//
// A row for each case, from the paper's loop on: what was withheld, what is named, and the time.
// Then of the cases without an effect, with one of the catalogue, and with two or one from outside
// it: on how many what was withheld is named or in a class, and on how many something else is.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/asked.h"
#include "bench/budget_row.h"
#include "bench/load_rig.h"
#include "bench/loop_base.h"
#include "bench/rig_loop_records.h"
#include "bench/seconds.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/kept_memory.h"

namespace howl {
namespace {

struct Tally {
  int cases = 0;
  int named = 0;  // all that was withheld
  int others = 0;
  int unknown = 0;
  double seconds = 0.0;
};

// The rig's names where the budget has others. Some that the catalogue has not are items.
std::string ItemOf(const std::string& effect) {
  // As earlier rigs had them.
  static const std::map<std::string, std::string> kItems = {
      {"x_mode_damping", "own_damping"},     {"x_duct_noise", "duct_noise"},
      {"x_p_highpass", "p_sensor_highpass"}, {"x_q_highpass", "q_sensor_highpass"},
      {"x_p_dropouts", "p_dropouts"},        {"x_delay_wander", "delay_wander"}};
  const auto at = kItems.find(effect);
  return at == kItems.end() ? effect : at->second;
}

bool IsOneOf(const BudgetEntry& entry, const std::string& item) {
  return entry.item == item || std::ranges::find(entry.equals, item) != entry.equals.end();
}

bool IsNamed(const Budget& budget, const std::string& item) {
  return std::ranges::find(budget.seen_in_samples, item, &SampleFact::effect) !=
             budget.seen_in_samples.end() ||
         std::ranges::any_of(budget.entries,
                             [&](const BudgetEntry& entry) { return IsOneOf(entry, item); });
}

void PrintCase(const std::filesystem::path& folder, const std::string& name,
               const nlohmann::json& rig, std::map<std::string, Tally>* tallies) {
  std::vector<std::string> wanted;
  std::string text;
  bool outside = false;
  for (const nlohmann::json& effect : rig.at("effects")) {
    wanted.push_back(ItemOf(effect.at("effect")));
    outside = outside || !effect.at("in_catalogue").get<bool>();
    text += (text.empty() ? "" : " + ") + wanted.back() + " " + effect.at("severity").dump() + " " +
            effect.at("parameters").dump();
  }
  if (!Asked("EFFECTS", wanted.empty() ? "none" : wanted[0])) return;
  const Config config = LoadConfig(folder / "cases" / name / "config.yaml", LoopsTaken::kAny);
  const double begun = Seconds();
  const LoopDiagnosis found =
      DiagnoseLoops(LoopRecordsOf(LoadRig(config)), LoopBaseOf(config), {.one_delay = true});
  const double seconds = Seconds() - begun;
  const Budget& budget = *found.diagnosis.budget;
  Tally& tally = (*tallies)[wanted.empty() ? "none"
                            : outside      ? "from outside"
                                           : std::to_string(wanted.size()) + " of the catalogue"];
  const bool named =
      std::ranges::all_of(wanted, [&](const std::string& item) { return IsNamed(budget, item); });
  const bool others = std::ranges::any_of(budget.entries, [&](const BudgetEntry& entry) {
    return std::ranges::none_of(wanted,
                                [&](const std::string& item) { return IsOneOf(entry, item); });
  });
  const bool unknown = found.diagnosis.kind == VerdictKind::kUnknown;
  ++tally.cases;
  tally.named += named ? 1 : 0;
  tally.others += others ? 1 : 0;
  tally.unknown += unknown ? 1 : 0;
  tally.seconds += seconds;
  std::printf("%s %s%s%s %s | ", name.c_str(), named ? "NAMED" : "MISSED", others ? " OTHERS" : "",
              unknown ? " UNKNOWN" : "", text.empty() ? "none" : text.c_str());
  PrintBudget(budget);
  std::printf(" | lines %.1f %.1f | %.0f s\n", found.acoustics.nats, found.flame.nats, seconds);
  std::fflush(stdout);
}

int Run(int argc, char** argv) {
  const std::filesystem::path folder = argv[1];
  std::ifstream file(folder / "key" / "key.json");
  const nlohmann::json key = nlohmann::json::parse(file);
  const std::vector<std::string> asked(argv + 2, argv + argc);
  std::map<std::string, Tally> tallies;
  for (const auto& [name, rig] : key.at("cases").items()) {
    if (!asked.empty() && std::ranges::find(asked, name) == asked.end()) continue;
    PrintCase(folder, name, rig, &tallies);
  }
  for (const auto& [group, tally] : tallies) {
    std::printf("%-20s %d cases: named %d, others on %d, unknown %d, %.0f s a case\n",
                group.c_str(), tally.cases, tally.named, tally.others, tally.unknown,
                tally.seconds / tally.cases);
  }
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: loop_trial_study TRIAL_FOLDER [CASE ...]\n");
    return 2;
  }
  howl::KeepFreedMemory();
  return howl::Run(argc, argv);
}
