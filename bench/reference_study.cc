// Known effects put into measured records, diagnosed against the untouched records as reference:
//
//   reference_study CONFIG [same|halves|neighbours] [EFFECT]
//
// same: the reference is the same record without the effect; halves: the reference is the first
// half in time, the rig the second; neighbours: every other operating point is the reference.
#include <cstdio>
#include <cstring>
#include <string>

#include "bench/known_effects.h"
#include "bench/load_rig.h"
#include "bench/measured_rig.h"
#include "io/config/reading/config_reading.h"

namespace howl {
namespace {

// Those in a cycle: the amplitude of p is above a fifth of the largest.
MeasuredRig Cycling(const MeasuredRig& all) {
  double largest = 0.0;
  for (const DiagnosisExperiment& each : all) {
    largest = std::max(largest, AmplitudeOf(each.record.pressure));
  }
  MeasuredRig out;
  for (const DiagnosisExperiment& each : all) {
    if (AmplitudeOf(each.record.pressure) > 0.2 * largest) out.push_back(each);
  }
  return out;
}

void Study(const MeasuredRig& all, const std::string& mode, const std::string& only) {
  MeasuredRig rig = Cycling(all);
  MeasuredRig reference = rig;
  if (mode == "halves") {
    reference = Part(reference, 0.0, 0.5);
    rig = Part(rig, 0.5, 1.0);
  } else if (mode == "neighbours") {
    reference.clear();
    MeasuredRig between;
    for (std::size_t e = 0; e < rig.size(); ++e) {
      (e % 2 == 0 ? reference : between).push_back(rig[e]);
    }
    rig = between;
  }
  std::printf("%s: reference of %zu, rig of %zu operating points\n", mode.c_str(), reference.size(),
              rig.size());
  for (const KnownEffect& known : KnownEffects()) {
    if (!only.empty() && known.effect != only) continue;
    MeasuredRig touched = rig;
    known.put(&touched);
    DiagnosisOptions options;
    options.reference = reference;
    const Diagnosis d = Diagnose(touched, options);
    const char* kind = d.kind == VerdictKind::kNone      ? "none"
                       : d.kind == VerdictKind::kUnknown ? "unknown"
                                                         : d.effect.c_str();
    std::string others;
    for (const std::string& other : d.indistinguishable) others += " " + other;
    std::printf("%-18s %-8s %-22s gap %.3f -> %.3f floor %.3f unknown %.2f |%s\n",
                known.effect.c_str(), known.strength.c_str(), kind, d.gap_before, d.gap_after,
                d.gap_floor, d.probability_unknown, others.c_str());
    std::printf("    slack A %.0f -> %.0f, B %.0f -> %.0f; gains", d.slack_acoustic_before,
                d.slack_acoustic_after, d.slack_flame_before, d.slack_flame_after);
    for (std::size_t i = 0; i < 4; ++i) {
      const Candidate& c = d.candidates[i];
      std::printf("  %s %.1f", c.effect.c_str(), c.gain);
      if (!c.parameters.empty()) std::printf(" (%.4g)", c.parameters[0].value);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "reference_study CONFIG [same|halves|neighbours] [EFFECT]\n");
    return 2;
  }
  const std::string mode = argc > 2 ? argv[2] : "halves";
  howl::Study(howl::LoadRig(howl::LoadConfig(argv[1])), mode, argc > 3 ? argv[3] : "");
  return 0;
}
