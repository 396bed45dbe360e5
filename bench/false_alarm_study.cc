// False alarms of the diagnosis on rigs with no effect (null_rig.h). Prints a line for each rig
// that is accused, and the rate with its 95 % interval (Wilson).
//
//   false_alarm_study [RIGS] [SEED]
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/null_rig.h"
#include "estimation/parallel.h"
#include "trial/tally.h"

int main(int argc, char** argv) {
  using namespace howl;
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 20;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  std::vector<Diagnosis> found(static_cast<std::size_t>(rigs));
  std::vector<std::string> texts(static_cast<std::size_t>(rigs));
  RunUnits(static_cast<std::size_t>(rigs), 0, [&](std::size_t i) {
    const NullRig rig = DrawNullRig(DeriveSeed(seed, i));
    texts[i] = rig.text;
    DiagnosisOptions options;
    options.threads = 1;
    found[i] = Diagnose(Recorded(rig), options);
  });
  Tally accused;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Diagnosis& d = found[i];
    accused.Count(d.kind != VerdictKind::kNone);
    if (d.kind == VerdictKind::kNone) continue;
    std::printf("%4zu %s: %s gain %.1f, gap %.3f to %.3f, slack A %.0f B %.0f\n", i,
                texts[i].c_str(), d.kind == VerdictKind::kUnknown ? "unknown" : d.effect.c_str(),
                d.candidates.at(0).gain, d.gap_before, d.gap_after, d.slack_acoustic_before,
                d.slack_flame_before);
  }
  std::printf("accused: %d of %d (95 %%: %.3f to %.3f)\n", accused.right, accused.total,
              accused.Low(), accused.High());
  return 0;
}
