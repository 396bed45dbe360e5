// Known effects put into measured records, and what the budget of loops names beside what the
// records lack anyway:
//
//   [EFFECTS=mains_hum,channel_skew] [WITH=own_damping,duct_noise] [MOST_ITEMS=2]
//       loop_effects_study CONFIG [EXPERIMENT ...]
//
// EFFECTS: of known_effects.h, those asked for; all where not given.
// WITH: the items that the rig's own budget has named (loop_budget_study), with which every search
// begins, as `howl diagnose --with` does; where not given that budget is made first.
// MOST_ITEMS: how many a search may add beside those, as `howl diagnose --most-items`.
// A row for each effect: whether the verdict is unknown, what was added beside those, its value and
// what is lost without it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "bench/asked.h"
#include "bench/budget_row.h"
#include "bench/known_effects.h"
#include "bench/load_rig.h"
#include "bench/loop_base.h"
#include "bench/rig_loop_records.h"
#include "bench/seconds.h"
#include "diagnosis/loop_budget/forms/shared_effect.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/kept_memory.h"

namespace howl {
namespace {

void PrintRow(const std::string& what, const LoopDiagnosis& found, double seconds) {
  std::printf("%-26s %s", what.c_str(),
              found.diagnosis.kind == VerdictKind::kUnknown ? "unknown " : "");
  PrintBudget(*found.diagnosis.budget);
  std::printf(" | %.0f s\n", seconds);
  std::fflush(stdout);
}

// In the order in which they came. Instruments that the rig has itself are looked for anew: with a
// known one they make one.
std::vector<std::string> ItemsOf(const Budget& budget) {
  const auto instrument = [](const std::string& id) {
    return std::ranges::any_of(SharedEffects(), [&](const EffectPointer& effect) {
      return effect->id() == id && !IsFlameFilter(*effect);
    });
  };
  std::vector<std::string> out;
  for (const BudgetEntry& entry : budget.entries) {
    if (!instrument(entry.item)) out.push_back(entry.item);
  }
  return out;
}

std::vector<std::string> ItemsOf(const char* list) {
  std::vector<std::string> out;
  std::istringstream items(list);
  for (std::string id; std::getline(items, id, ',');) out.push_back(id);
  return out;
}

int Run(int argc, char** argv) {
  const Config config = LoadConfig(argv[1], LoopsTaken::kAny);
  const MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  const LoopForm base = LoopBaseOf(config);
  LoopBudgetOptions how;
  if (const char* const most = std::getenv("MOST_ITEMS")) how.most_items = std::stoul(most);
  if (const char* const with = std::getenv("WITH")) {
    how.given = ItemsOf(with);
  } else {
    const double begun = Seconds();
    const LoopDiagnosis clean = DiagnoseLoops(LoopRecordsOf(rig), base, {});
    PrintRow("untouched", clean, Seconds() - begun);
    how.given = ItemsOf(*clean.diagnosis.budget);
  }
  for (const KnownEffect& known : KnownEffects()) {
    if (!Asked("EFFECTS", known.effect)) continue;
    MeasuredRig touched = rig;
    known.put(&touched);
    const double begun = Seconds();
    const LoopDiagnosis found = DiagnoseLoops(LoopRecordsOf(touched), base, how);
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
