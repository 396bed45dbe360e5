// The budget of a rig's gap, step by step, for some of a config's operating points or for all:
//
//   GLOG_v=1 budget_study CONFIG [EXPERIMENT ...]
//
// LOWPASS_Q_HZ, SKEW_Q_S, CLIP_P, HUM_Q and CROSSTALK in the environment put a known effect into
// the records first (measured_rig.h).
#include <glog/logging.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/load_rig.h"
#include "bench/measured_rig.h"
#include "diagnosis/budget/budget.h"
#include "io/config/reading/config_reading.h"

namespace howl {
namespace {

double Number(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : 0.0;
}

int Run(int argc, char** argv) {
  const Config config = LoadConfig(argv[1]);
  MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  if (const double hz = Number("LOWPASS_Q_HZ"); hz > 0.0) LowPassQ(&rig, hz);
  if (const double skew_s = Number("SKEW_Q_S"); skew_s != 0.0) SkewQ(&rig, skew_s);
  if (const double fraction = Number("CLIP_P"); fraction > 0.0)
    ClipSignal(&rig, Channel::kPressure, fraction);
  if (const double rel = Number("HUM_Q"); rel > 0.0) HumInQ(&rig, rel);
  if (const double rel = Number("CROSSTALK"); rel != 0.0) CrosstalkToQ(&rig, rel);
  BaseModel model;
  model.own_delays = true;
  const Budget budget = FindBudget(rig, model, {});
  std::printf("gap %.3f\n", budget.gap_before);
  for (const BudgetEntry& entry : budget.entries) {
    std::printf("%-26s %.3f -> %.3f  lost %8.1f nats (halves %.1f %.1f), gap %.3f, on %zu of %zu",
                entry.item.c_str(), entry.gap_before, entry.gap_after, entry.lost_nats,
                entry.lost_on_halves[0], entry.lost_on_halves[1], entry.lost_gap,
                entry.experiments_better, budget.experiments);
    for (const EstimatedParameter& p : entry.parameters) {
      std::printf("  %s %.4g [%.4g, %.4g]", p.name.c_str(), p.value, p.low, p.high);
    }
    for (const std::string& id : entry.equals) std::printf(" = %s", id.c_str());
    std::printf("\n");
  }
  std::printf("left %.3f, model errors %.3f %.3f\n", budget.gap_left, budget.acoustic_error,
              budget.flame_error);
  for (const Place& place : budget.left) {
    std::printf("  %s %.0f .. %.0f Hz, share %.2f, %zu points\n",
                std::string(LoopBlockName(place.block)).c_str(), place.low_hz, place.high_hz,
                place.share, place.experiments.size());
  }
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  return howl::Run(argc, argv);
}
