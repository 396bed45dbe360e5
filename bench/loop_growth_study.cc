// How a diagnosis of records behaves as they grow longer and points more:
//
//   [EFFECTS=none,low-pass] loop_growth_study RIGS POINTS DURATION_S [DURATION_S ...]
//
// Ducts of two modes with complex residues (tests/estimation/record_fit/modal_loop.h), with loop
// gains of 1.2 to 1.8, diagnosed from their own loop on, with all items offered. A row for each
// duration, without an effect and with q recorded through a low-pass of first order: on how many
// rigs that is named, on how many it is within the odds of what is, on how many something else is,
// what nats it is worth, its value's error in deviations, and the time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "bench/asked.h"
#include "bench/seconds.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/analysis/spectra/statistics.h"
#include "estimation/kept_memory.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl {
namespace {

constexpr double kCutoff_hz = 2000.0;
constexpr const char* kLowPass = "q_sensor_lowpass";
constexpr double kDeviationsOf95 = 1.96;

const char* NameOf(bool low_pass) { return low_pass ? "low-pass" : "none"; }

std::vector<LoopRecord> Rig(int rig, int points, double duration_s, bool low_pass) {
  ModalInstruments instruments;
  if (low_pass) instruments = [](Record* record) { LowPass(kCutoff_hz, record); };
  std::vector<LoopRecord> out;
  for (int point = 0; point < points; ++point) {
    const double gain = 1.2 + 0.6 * point / std::max(points - 1, 1);
    const auto seed = static_cast<std::uint64_t>(1000 * rig + point + 1);
    out.push_back(DuctAt(gain, duration_s, seed, instruments));
  }
  return out;
}

void PrintRow(int rigs, int points, double duration_s, bool low_pass) {
  int named = 0;
  int in_class = 0;
  int others = 0;
  int unknown = 0;
  std::vector<double> nats;
  std::vector<double> errors;
  std::string which;
  const double begun = Seconds();
  for (int rig = 0; rig < rigs; ++rig) {
    LoopBudgetOptions options;
    options.seed = static_cast<std::uint64_t>(rig + 1);
    const LoopDiagnosis found =
        DiagnoseLoops(Rig(rig, points, duration_s, low_pass), DuctsForm(), options);
    bool other = false;
    for (const BudgetEntry& entry : found.diagnosis.budget->entries) {
      if (entry.item != kLowPass || !low_pass) {
        if (std::ranges::find(entry.equals, kLowPass) != entry.equals.end()) {
          ++in_class;
        } else {
          other = true;
        }
        which += " " + entry.item + " (" + std::to_string(std::lround(entry.lost_nats)) + ")";
        continue;
      }
      ++named;
      nats.push_back(entry.lost_nats);
      const EstimatedParameter& cutoff = entry.parameters[0];
      errors.push_back(std::abs(cutoff.value - kCutoff_hz) * 2.0 * kDeviationsOf95 /
                       (cutoff.high - cutoff.low));
    }
    others += other ? 1 : 0;
    unknown += found.diagnosis.kind == VerdictKind::kUnknown ? 1 : 0;
  }
  const auto median = [](const std::vector<double>& x) {
    return x.empty() ? std::numeric_limits<double>::quiet_NaN() : Median(x);
  };
  std::printf(
      "%4.1f s %2d points %-10s of %d rigs: named %d, in a class %d, others on %d, unknown %d; "
      "nats %.0f, error "
      "%.1f; %.0f s a rig%s\n",
      duration_s, points, NameOf(low_pass), rigs, named, in_class, others, unknown, median(nats),
      median(errors), (Seconds() - begun) / rigs, which.c_str());
  std::fflush(stdout);
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: loop_growth_study RIGS POINTS DURATION_S [DURATION_S ...]\n");
    return 2;
  }
  howl::KeepFreedMemory();
  for (int i = 3; i < argc; ++i) {
    for (const bool low_pass : {false, true}) {
      if (!howl::Asked("EFFECTS", howl::NameOf(low_pass))) continue;
      howl::PrintRow(std::atoi(argv[1]), std::atoi(argv[2]), std::atof(argv[i]), low_pass);
    }
  }
  return 0;
}
