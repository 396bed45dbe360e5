#include "app/input/record_solution.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "app/input/fit_state.h"
#include "app/input/record_input.h"
#include "app/text/text_table.h"
#include "estimation/analysis/analyse.h"
#include "estimation/parallel.h"
#include "io/user_error.h"

namespace howl {
namespace {

void RequireRecords(const Config& config) {
  for (const ExperimentConfig& each : config.experiments) {
    if (each.record) continue;
    throw UserError(config.source.string(), each.line, "experiments",
                    each.experiment.name +
                        " has no record, expected one of p and q: the config's model states a loop "
                        "that is fitted to records");
  }
}

// The cycle's frequency, or that of the strongest peak where there is no cycle.
double CycleOf(const Analysis& analysis) {
  const Characteristics& c = analysis.characteristics;
  return c.state == CycleState::kNoLimitCycle ? c.peak.frequency_hz : c.frequency_hz.value;
}

// Some 300 bins in the band, five for each parameter of a loop of eight modes, and a band that
// reaches beyond the second harmonic.
constexpr double kFewestCycles = 50.0;
constexpr double kFewestSamplesPerCycle = 6.0;

void RequireUsable(const Config& config, std::size_t index, const NamedRecord& record,
                   double cycle_hz) {
  const auto fail = [&](const std::string& what) {
    throw UserError(config.source.string(), config.experiments[index].line, "experiments",
                    record.name + what);
  };
  if (record.record.heat_release.empty()) {
    fail(
        " has no heat release, expected p and q: the config's model states a loop that is fitted "
        "to both");
  }
  if (!(cycle_hz > 0.0)) fail(" shows no peak of p, expected one at which its loop resonates");
  const Record& samples = record.record;
  const double cycles =
      cycle_hz * static_cast<double>(samples.pressure.size()) / samples.sampling_hz;
  if (cycles < kFewestCycles) {
    fail(" holds " + Significant(cycles, 3) + " periods at " + Significant(cycle_hz, 4) +
         " Hz, expected at least " + Significant(kFewestCycles, 2) + " to fit a loop to");
  }
  if (samples.sampling_hz < kFewestSamplesPerCycle * cycle_hz) {
    fail(" has " + Significant(samples.sampling_hz / cycle_hz, 3) + " samples a period at " +
         Significant(cycle_hz, 4) + " Hz, expected at least " +
         Significant(kFewestSamplesPerCycle, 2) + " to fit a loop to");
  }
}

// Where the config states them: a record needs more of them than a table does.
std::optional<std::size_t> StartsOf(const Config& config) {
  const LocatedMember* const solver = config.tree.Find("solver");
  if (solver == nullptr || solver->value.Find("starts") == nullptr) return std::nullopt;
  return static_cast<std::size_t>(config.solver.starts);
}

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
  std::vector<OtherDelay> found = OtherDelaysOf(record, fit.structure, fit.points[e]);
  state.Keep(key, std::string(reinterpret_cast<const char*>(found.data()),
                              found.size() * sizeof(OtherDelay)));
  return found;
}

}  // namespace

RecordSolution SolveRecords(const Config& config, const Options& options, SolvedFor what) {
  RequireRecords(config);
  const std::vector<NamedRecord> records = LoadRecords(config);
  const AnalysisSet set = AnalyseRecords(records, MakeAnalysisOptions(config, options));
  RecordSolution out;
  out.points.resize(records.size());
  for (std::size_t e = 0; e < records.size(); ++e) {
    const NamedRecord& record = records[e];
    const Characteristics& c = set.analyses[e].characteristics;
    RequireUsable(config, e, record, CycleOf(set.analyses[e]));
    out.names.push_back(record.name);
    out.cycle_amplitude.push_back(c.state == CycleState::kNoLimitCycle ? 0.0 : c.p_amplitude);
  }
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    out.points[e] = {records[e].phi, MakeRecordSpectra(records[e].record, CycleOf(set.analyses[e]),
                                                       config.record_loop->flame_input)};
  });
  FitState state(config, options, what == SolvedFor::kFit);
  RecordsFitOptions fit_options;
  fit_options.starts = StartsOf(config).value_or(fit_options.starts);
  fit_options.seed = options.seed;
  fit_options.threads = options.threads;
  fit_options.units = &state;
  out.loop = FitLoop(out.points, *config.record_loop, fit_options);
  out.fitted.resize(records.size());
  out.other_delays.resize(records.size());
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    const RecordsFit& fit = out.loop.fit;
    out.fitted[e] = FittedLoopOf(out.points[e].record, fit.structure, fit.points[e]);
    if (what != SolvedFor::kFit) return;
    out.other_delays[e] =
        KeptOtherDelays(state, "other_delays/" + std::to_string(e), out.points[e].record, fit, e);
  });
  std::vector<OnsetPoint> points;
  for (std::size_t e = 0; e < records.size(); ++e) {
    points.push_back({records[e].phi, out.fitted[e].small_signal});
  }
  out.onset = OnsetOf(points);
  if (what == SolvedFor::kFit) state.Complete();
  return out;
}

}  // namespace howl
