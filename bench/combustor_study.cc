// What the two-mode model misses of measured records, and whether two disjoint halves of the
// operating points say the same:
//
//   combustor_study CONFIG
#include <cstdio>
#include <string>

#include "bench/load_rig.h"
#include "bench/measured_rig.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/gap/slack.h"
#include "io/config/reading/config_reading.h"

namespace howl {
namespace {

void Report(const std::string& title, const MeasuredRig& rig) {
  const Diagnosis d = Diagnose(rig, {});
  std::printf("%s: %zu operating points\n", title.c_str(), rig.size());
  std::printf("  verdict %s %s (unknown %.2f), gap held out %.3f -> %.3f, floor %.3f\n",
              d.kind == VerdictKind::kNone      ? "none"
              : d.kind == VerdictKind::kUnknown ? "unknown"
                                                : "effect",
              d.effect.c_str(), d.probability_unknown, d.gap_before, d.gap_after, d.gap_floor);
  for (const Place& place : d.where) {
    std::printf("  where %s, %.0f to %.0f Hz, %zu points, share %.2f\n",
                std::string(LoopBlockName(place.block)).c_str(), place.low_hz, place.high_hz,
                place.experiments.size(), place.share);
  }
  std::printf("  free slack: A %.0f -> %.0f, B %.0f -> %.0f\n", d.slack_acoustic_before,
              d.slack_acoustic_after, d.slack_flame_before, d.slack_flame_after);
  for (std::size_t i = 0; i < std::min<std::size_t>(5, d.candidates.size()); ++i) {
    const Candidate& c = d.candidates[i];
    std::printf("  %-24s gain %8.1f  shrinkage %5.1f %% [%5.1f, %5.1f]", c.effect.c_str(), c.gain,
                100.0 * c.shrinkage, 100.0 * c.shrinkage_low, 100.0 * c.shrinkage_high);
    for (const EstimatedParameter& p : c.parameters) {
      std::printf("  %s %.4g [%.4g, %.4g] %s", p.name.c_str(), p.value, p.low, p.high,
                  p.unit.c_str());
    }
    std::printf("\n");
  }
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  const EffectFit base = FitBase(records);
  const Slack slack = ComputeSlack(records, base);
  std::printf("  transfer error of cut A by band:");
  for (const SlackBand& band : slack.acoustic) {
    if (band.gain < 10.0) continue;
    std::printf(" %.0f-%.0f Hz %.0f (%.2f at %.0f deg)", band.low_hz, band.high_hz, band.gain,
                std::abs(band.error), std::arg(band.error) * 57.29577951308232);
  }
  std::printf("\n  tau %.3f ms; points:", 1e3 * base.tau_s);
  for (std::size_t e = 0; e < records.size(); ++e) {
    const Acoustics<double> a = ToAcoustics({}, base.experiments[e].acoustics);
    std::printf(" %s f0 %.1f omega %.1f xi %.3f N %.0f M %.0f slack B %.0f;",
                records[e].name.c_str(), records[e].at.cycle_frequency_hz, a.omega_hz, a.xi, a.N,
                a.M, slack.flame_by_experiment[e]);
  }
  std::printf("\n\n");
  std::fflush(stdout);
}

void Study(const std::filesystem::path& path) {
  const MeasuredRig all = LoadRig(LoadConfig(path));
  double largest = 0.0;
  for (const DiagnosisExperiment& each : all) {
    largest = std::max(largest, AmplitudeOf(each.record.pressure));
  }
  MeasuredRig cycling;
  MeasuredRig even;
  MeasuredRig odd;
  for (const DiagnosisExperiment& each : all) {
    if (AmplitudeOf(each.record.pressure) < 0.2 * largest) continue;
    (cycling.size() % 2 == 0 ? even : odd).push_back(each);
    cycling.push_back(each);
  }
  Report("all", all);
  Report("in a cycle", cycling);
  Report("in a cycle, first half (every other)", even);
  Report("in a cycle, second half", odd);
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "combustor_study CONFIG\n");
    return 2;
  }
  howl::Study(argv[1]);
  return 0;
}
