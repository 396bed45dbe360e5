// Whether the search for a second path's values ends at the likeliest of their maxima:
//
//   second_path_study DURATION_S [DURATION_S ...]
//
// Three ducts of two modes (tests/diagnosis/loop_budget/duct_rig.h), a share of whose flame is
// driven later. A row for each rig: what the search came to from the loop without the path, the
// maximum that is next to the path's true values, the nats by which the search missed it, and the
// search's time.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/seconds.h"
#include "diagnosis/loop_budget/trials/effect_profile.h"
#include "diagnosis/loop_budget/trials/shared_effect_trial.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl {
namespace {

constexpr std::array<double, 3> kGains = {1.2, 1.5, 1.8};
constexpr std::array<double, 3> kShares = {0.22, 0.3, 0.45};
constexpr double kMissed = 1.0;  // nats

std::vector<LoopRecord> Rig(double duration_s, double share, double later_s) {
  std::vector<LoopRecord> out;
  for (const double gain : kGains) {
    out.push_back(DuctAt(gain, duration_s, static_cast<std::uint64_t>(100.0 * gain), {},
                         [&](ModalLoop* loop) {
                           loop->share = share;
                           loop->later_s = later_s;
                         }));
  }
  return out;
}

LoopItem PathBeforeTheCurve() {
  for (const LoopItem& item : AllLoopItems()) {
    if (KeyOf(item) == "second_delay_pathbefore_flame") return item;
  }
  std::abort();
}

// Whether the search missed the maximum next to the truth.
bool PrintRow(double duration_s, double share, double later_s) {
  const LoopRecords records(Rig(duration_s, share, later_s), 0);
  LoopBudgetOptions options;
  options.starts = 4;
  const LoopFit from = DuctsFit(records, options);
  const LoopItem item = PathBeforeTheCurve();
  const double begun = Seconds();
  const double standing = StandingEvidence(records, from, "", options);
  const LoopTrial trial =
      TryFarFromNull(records, from, standing,
                     TrySharedEffect(records, from, standing, item, "", options), "", options);
  const double taken_s = Seconds() - begun;
  EffectProfile profile(records, from, item, MaximumKnown::kClosely, "", options);
  const auto maximum = [&](const std::vector<double>& values,
                           const std::vector<Eigen::VectorXd>& starts) {
    EffectPoint at = profile.At(ToSearch(*item.effect, values), starts);
    profile.AtOtherDelays(&at);
    return profile.From(std::move(at)).at;
  };
  const EffectPoint found = maximum(trial.model.effects.back().values, trial.starts[0]);
  const EffectPoint next = maximum({share, later_s}, ParametersOf(from));
  const double missed = next.log_posterior - found.log_posterior;
  std::printf("%8.2f %8.2f %8.2f %8.3f %8.3f %8.3f %8.3f %8.1f %8.2f\n", duration_s, share,
              1e3 * later_s, found.u[0], 1e3 * std::exp(found.u[1]), next.u[0],
              1e3 * std::exp(next.u[1]), missed, taken_s);
  std::fflush(stdout);
  return missed > kMissed;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "second_path_study DURATION_S [DURATION_S ...]\n");
    return 2;
  }
  std::printf("%8s %8s %8s %8s %8s %8s %8s %8s %8s\n", "s", "share", "later ms", "found", "ms",
              "next to", "ms", "missed", "s");
  int rigs = 0;
  int missed = 0;
  for (int i = 1; i < argc; ++i) {
    for (const double share : howl::kShares) {
      for (int later_ms = 1; later_ms <= 8; ++later_ms) {
        ++rigs;
        if (howl::PrintRow(std::atof(argv[i]), share, 1e-3 * later_ms)) ++missed;
      }
    }
  }
  std::printf("%d of %d missed by more than %g nats\n", missed, rigs, howl::kMissed);
  return 0;
}
