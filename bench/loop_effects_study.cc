// Known effects put into measured records, and what the budget of loops names beside what the
// records lack anyway:
//
//   [EFFECTS=mains_hum,channel_skew] loop_effects_study CONFIG [EXPERIMENT ...]
//
// EFFECTS: of known_effects.h, those asked for; all where not given.
// The budget of the untouched records comes first. Its best loop, without the instruments in it,
// then is the base from which records with each effect in them are diagnosed, as by a user who has
// taken the budget's advice: a row with what was added, its value and what is lost without it.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/asked.h"
#include "bench/budget_row.h"
#include "bench/known_effects.h"
#include "bench/load_rig.h"
#include "bench/loop_base.h"
#include "bench/seconds.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/kept_memory.h"

namespace howl {
namespace {

void PrintRow(const std::string& what, const LoopDiagnosis& found, double seconds) {
  std::printf("%-26s ", what.c_str());
  PrintBudget(*found.diagnosis.budget);
  std::printf(" | %.0f s\n", seconds);
  std::fflush(stdout);
}

int Run(int argc, char** argv) {
  const Config config = LoadConfig(argv[1], LoopsTaken::kAny);
  const MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  double begun = Seconds();
  const LoopDiagnosis clean = DiagnoseLoops(LoopRecordsOf(rig), LoopBaseOf(config), {});
  PrintRow("untouched", clean, Seconds() - begun);
  // Instruments that the rig has itself are looked for anew: with a known one they make one.
  LoopForm base = clean.best;
  base.effects.clear();
  for (const KnownEffect& known : KnownEffects()) {
    const std::vector<std::string> ids = LoopItemIds();
    if (known.effect != "none" && std::ranges::find(ids, known.effect) == ids.end()) continue;
    if (!Asked("EFFECTS", known.effect)) continue;
    MeasuredRig touched = rig;
    known.put(&touched);
    begun = Seconds();
    const LoopDiagnosis found = DiagnoseLoops(LoopRecordsOf(touched), base, {});
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
