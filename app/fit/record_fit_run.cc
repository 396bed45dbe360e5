#include "app/fit/record_fit_run.h"

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/input/record_input.h"
#include "app/text/record_fit_text.h"
#include "app/text/text_table.h"
#include "estimation/analysis/analyse.h"
#include "estimation/parallel.h"
#include "io/results/record_solution_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"

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

RecordSolution Solve(const Config& config, const Options& options) {
  const std::vector<NamedRecord> records = LoadRecords(config);
  const AnalysisSet set = AnalyseRecords(records, MakeAnalysisOptions(config, options));
  RecordSolution out;
  out.points.resize(records.size());
  for (std::size_t e = 0; e < records.size(); ++e) {
    const NamedRecord& record = records[e];
    RequireUsable(config, e, record, CycleOf(set.analyses[e]));
    out.names.push_back(record.name);
  }
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    out.points[e] = {records[e].phi, MakeRecordSpectra(records[e].record, CycleOf(set.analyses[e]),
                                                       config.record_loop->flame_input)};
  });
  RecordsFitOptions fit_options;
  fit_options.starts = StartsOf(config).value_or(fit_options.starts);
  fit_options.seed = options.seed;
  fit_options.threads = options.threads;
  out.loop = FitLoop(out.points, *config.record_loop, fit_options);
  out.fitted.resize(records.size());
  out.other_delays.resize(records.size());
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    const RecordsFit& fit = out.loop.fit;
    out.fitted[e] = FittedLoopOf(out.points[e].record, fit.structure, fit.points[e]);
    out.other_delays[e] = OtherDelaysOf(out.points[e].record, fit.structure, fit.points[e]);
  });
  std::vector<OnsetPoint> points;
  for (std::size_t e = 0; e < records.size(); ++e) {
    points.push_back({records[e].phi, out.fitted[e].small_signal});
  }
  out.onset = OnsetOf(points);
  return out;
}

}  // namespace

int RunRecordFit(const Config& config, const Options& options) {
  RequireRecords(config);
  const RecordSolution solution = Solve(config, options);
  const std::filesystem::path path = options.out / "solution.json";
  WriteWholeFile(path, RecordSolutionJson(solution).dump(2) + "\n");
  if (!options.quiet) {
    std::printf("%s", RecordFitText(solution, config.operating_parameter).c_str());
    std::printf("written: %s\n", path.c_str());
  }
  return solution.Converged() ? kDone : kNegativeAnswer;
}

}  // namespace howl
