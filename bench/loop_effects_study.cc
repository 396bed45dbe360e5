// Known effects put into measured records, and what the budget of loops names beside what the
// records lack anyway:
//
//   [EFFECTS=mains_hum,channel_skew] loop_effects_study CONFIG [EXPERIMENT ...]
//
// EFFECTS: of known_effects.h, those asked for; all where not given.
// The budget of the untouched records comes first. Its best loop then is the base from which
// records with each effect in them are diagnosed, as by a user who has taken the budget's advice: a
// row with what was added, its value and what is lost without it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/known_effects.h"
#include "bench/load_rig.h"
#include "bench/loop_base.h"
#include "bench/seconds.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/kept_memory.h"

namespace howl {
namespace {

void PrintRow(const std::string& what, const LoopDiagnosis& found, double seconds) {
  const Budget& budget = *found.diagnosis.budget;
  std::printf("%-26s gap %.3f to %.3f |", what.c_str(), budget.gap_before, budget.gap_left);
  for (const BudgetEntry& entry : budget.entries) {
    std::printf(" %s (%.0f nats, %zu of %zu", entry.item.c_str(), entry.lost_nats,
                entry.experiments_better, budget.experiments);
    for (const EstimatedParameter& p : entry.parameters) {
      std::printf(", %s %.4g, %.4g .. %.4g", p.name.c_str(), p.value, p.low, p.high);
    }
    std::printf(")");
    for (const std::string& other : entry.equals) std::printf(" = %s", other.c_str());
  }
  std::printf(" | %.0f s\n", seconds);
  std::fflush(stdout);
}

bool Asked(const std::string& effect) {
  const char* const only = std::getenv("EFFECTS");
  return only == nullptr ||
         ("," + std::string(only) + ",").find("," + effect + ",") != std::string::npos;
}

int Run(int argc, char** argv) {
  const Config config = LoadConfig(argv[1], LoopsTaken::kAny);
  const MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  double begun = Seconds();
  const LoopDiagnosis clean = DiagnoseLoops(LoopRecordsOf(rig), LoopBaseOf(config), {});
  PrintRow("untouched", clean, Seconds() - begun);
  for (const KnownEffect& known : KnownEffects()) {
    const std::vector<std::string> ids = LoopItemIds();
    if (known.effect != "none" && std::ranges::find(ids, known.effect) == ids.end()) continue;
    if (!Asked(known.effect)) continue;
    MeasuredRig touched = rig;
    known.put(&touched);
    begun = Seconds();
    const LoopDiagnosis found = DiagnoseLoops(LoopRecordsOf(touched), clean.best, {});
    PrintRow(known.effect + " " + known.strength, found, Seconds() - begun);
  }
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  howl::KeepFreedMemory();
  return howl::Run(argc, argv);
}
