#include "app/input/record_solution.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/input/fit_state.h"
#include "app/input/usable_records.h"
#include "estimation/health/mended_records.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

// The other delays take a fit each, as those of records_fit.h do: one unit a point.
std::vector<OtherDelay> KeptOtherDelays(FitState& state, const std::string& key,
                                        const RecordSpectra& record, const RecordsFit& fit,
                                        std::size_t e) {
  if (const std::optional<std::string> bytes = state.Recall(key)) {
    std::vector<OtherDelay> kept(bytes->size() / sizeof(OtherDelay));
    if (kept.size() * sizeof(OtherDelay) == bytes->size()) {
      if (!kept.empty()) std::memcpy(kept.data(), bytes->data(), bytes->size());
      return kept;
    }
  }
  std::vector<OtherDelay> found = OtherDelaysOf(record, fit.structure, fit.points[e], fit.prior[e]);
  state.Keep(key, std::string(reinterpret_cast<const char*>(found.data()),
                              found.size() * sizeof(OtherDelay)));
  return found;
}

}  // namespace

RecordSolution SolveRecords(const Config& config, const Options& options, SolvedFor what) {
  RequireRecords(config);
  std::vector<UsableRecord> usable = LoadUsableRecords(config, options);
  RecordSolution out;
  for (const UsableRecord& record : usable) {
    out.names.push_back(record.record.name);
    out.cycle_amplitude.push_back(record.cycle_amplitude);
  }
  std::vector<LoopRecord> records = LoopRecordsOf(std::move(usable));
  for (const LoopRecord& each : records) {
    out.stuck.push_back({ShareStuck(each.record.pressure), ShareStuck(each.record.heat_release)});
    out.clipped.push_back(ShareClipped(each.record.pressure));
  }
  records = MendedRecords(std::move(records), {}, options.seed, options.threads);
  FitState state(config, options, "fit.state");
  if (what == SolvedFor::kFit) state.BeginAnewIfComplete();
  if (!options.quiet) state.SayWhereItStands();
  RecordsFitOptions fit_options;
  fit_options.starts = StatedStarts(config).value_or(fit_options.starts);
  fit_options.seed = options.seed;
  fit_options.threads = options.threads;
  fit_options.units = &state;
  out.loop = FitLoop(records, *config.record_loop, fit_options);
  out.halves = LoopsOfHalves(records, out.loop.points, out.loop.fit.structure, out.loop.halves);
  out.fitted.resize(records.size());
  out.other_delays.resize(records.size());
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    const RecordsFit& fit = out.loop.fit;
    out.fitted[e] = FittedLoopOf(out.loop.points[e].record, fit.structure, fit.points[e]);
    if (what != SolvedFor::kFit) return;
    out.other_delays[e] = KeptOtherDelays(state, "other_delays/" + std::to_string(e),
                                          out.loop.points[e].record, fit, e);
  });
  out.scales = ScalesOf(out.fitted, out.halves);
  Widen(out.scales, &out.fitted);
  std::vector<OnsetPoint> points;
  for (std::size_t e = 0; e < records.size(); ++e) {
    points.push_back({records[e].operating_parameter, out.fitted[e].small_signal});
  }
  out.onset = OnsetOf(points);
  if (what == SolvedFor::kFit) state.Complete();
  return out;
}

}  // namespace howl
