#include "app/diagnose/clipped_heat_release.h"

#include <algorithm>

#include "app/process/interruption.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/samples/sample_limits.h"
#include "estimation/health/clipped_samples.h"

namespace howl {
namespace {

constexpr char kClipping[] = "q_clipping";

bool MayBeClipped(const std::vector<double>& q) {
  return !q.empty() && ShareClipped(q) == 0.0 && ShareOnNoisyRails(q) > 0.0;
}

}  // namespace

bool HeatReleaseMayBeClipped(const std::vector<NamedRecord>& records) {
  const auto clipped = std::ranges::count_if(
      records, [](const NamedRecord& each) { return MayBeClipped(each.record.heat_release); });
  return 2 * clipped > std::ssize(records);
}

std::optional<Diagnosis> DiagnoseClippedHeatRelease(const std::vector<NamedRecord>& records,
                                                    const DiagnosisOptions& options) {
  const bool withheld = std::ranges::find(options.withheld, kClipping) != options.withheld.end();
  if (withheld || !HeatReleaseMayBeClipped(records)) return std::nullopt;
  std::vector<DiagnosisExperiment> experiments;
  for (const NamedRecord& each : records) experiments.push_back({each.name, each.phi, each.record});
  if (FindCutObstacle(experiments)) return std::nullopt;
  WatchForInterruption();
  Diagnosis found = Diagnose(experiments, options);
  if (found.stopped) {
    throw Interrupted("interrupted: nothing written; the same command begins anew");
  }
  if (found.kind != VerdictKind::kEffect || found.effect != kClipping) return std::nullopt;
  return found;
}

}  // namespace howl
