// The budget of measured records by the likelihood of loops (diagnosis/loop_budget):
//
//   loop_budget_study CONFIG [EXPERIMENT ...]
//
// From the paper's loop on, or from that of the config's model where it states another. With
// GLOG_v=1 and GLOG_logtostderr=1 it says what each step tried.
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/load_rig.h"
#include "bench/loop_base.h"
#include "bench/rig_loop_records.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/kept_memory.h"

namespace howl {
namespace {

void PrintPlaces(const Budget& budget) {
  for (const Place& place : budget.left) {
    std::printf("left: %s, %.0f to %.0f Hz, share %.2f at", LoopBlockName(place.block).data(),
                place.low_hz, place.high_hz, place.share);
    for (const std::string& name : place.experiments) std::printf(" %s", name.c_str());
    std::printf("\n");
  }
}

int Run(int argc, char** argv) {
  const auto begun = std::chrono::steady_clock::now();
  const Config config = LoadConfig(argv[1], LoopsTaken::kAny);
  const MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  const LoopDiagnosis found = DiagnoseLoops(LoopRecordsOf(rig), LoopBaseOf(config), {});
  const Budget& budget = *found.diagnosis.budget;
  std::printf("gap %.3f, left %.3f, floor %.3f\n", budget.gap_before, budget.gap_left,
              budget.floor);
  for (const BudgetEntry& entry : budget.entries) {
    std::printf(
        "%-24s gap %.3f to %.3f  lost without: %8.1f nats, gap %.3f, halves %.0f %.0f, "
        "%zu of %zu ",
        entry.item.c_str(), entry.gap_before, entry.gap_after, entry.lost_nats, entry.lost_gap,
        entry.lost_on_halves[0], entry.lost_on_halves[1], entry.experiments_better,
        budget.experiments);
    for (const EstimatedParameter& p : entry.parameters) {
      std::printf(" %s %.4g (%.4g .. %.4g)", p.name.c_str(), p.value, p.low, p.high);
    }
    for (const std::string& other : entry.equals) std::printf(" = %s", other.c_str());
    std::printf("\n");
  }
  PrintPlaces(budget);
  std::printf("lines: acoustics %.1f nats, size %.3f; flame %.1f nats, size %.3f\n",
              found.acoustics.nats, found.acoustics.size, found.flame.nats, found.flame.size);
  std::printf("%.0f s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  howl::KeepFreedMemory();
  return howl::Run(argc, argv);
}
