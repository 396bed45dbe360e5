#include "app/input/usable_records.h"

#include <string>
#include <utility>

#include "app/input/record_input.h"
#include "app/text/text_table.h"
#include "io/user_error.h"

namespace howl {
namespace {

// The cycle's frequency, or that of the strongest peak where there is no cycle.
double CycleOf(const Analysis& analysis) {
  const Characteristics& c = analysis.characteristics;
  return c.state == CycleState::kNoLimitCycle ? c.peak.frequency_hz : c.frequency_hz.value;
}

// Some 300 bins in the band, five for each parameter of a loop of eight modes, and a band that
// reaches beyond the second harmonic.
constexpr double kFewestCycles = 50.0;
constexpr double kFewestSamplesPerCycle = 6.0;

void RequireUsable(const Config& config, const NamedRecord& record, double cycle_hz) {
  const auto fail = [&](const std::string& what) {
    throw UserError(config.source.string(), ExperimentNamed(config, record.name).line,
                    "experiments", record.name + what);
  };
  if (record.record.heat_release.empty()) {
    fail(" has no heat release, expected p and q: the loop is fitted to both");
  }
  if (!(cycle_hz > 0.0)) fail(" shows no peak of p, expected one at which its loop resonates");
  const Record& samples = record.record;
  if (samples.pressure == samples.heat_release) {
    fail(" has the same samples as p and as q, expected two signals");
  }
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

}  // namespace

void RequireRecords(const Config& config) {
  for (const ExperimentConfig& each : config.experiments) {
    if (each.record) continue;
    throw UserError(config.source.string(), each.line, "experiments",
                    each.experiment.name +
                        " has no record, expected one of p and q: the config's model states a loop "
                        "that is fitted to records");
  }
}

std::vector<UsableRecord> LoadUsableRecords(const Config& config, const Options& options) {
  return UsableRecords(config, options, LoadRecords(config));
}

void RequireUsable(const Config& config, const std::vector<NamedRecord>& records,
                   const AnalysisSet& set) {
  if (records.empty()) {
    throw UserError(config.source.string(), config.experiments.front().line, "experiments",
                    "no experiment has a record, expected at least one of p and q");
  }
  for (std::size_t e = 0; e < records.size(); ++e) {
    RequireUsable(config, records[e], CycleOf(set.analyses[e]));
  }
}

std::vector<UsableRecord> UsableRecords(const Config& config, const Options& options,
                                        std::vector<NamedRecord> records) {
  const AnalysisSet set = records.empty()
                              ? AnalysisSet()
                              : AnalyseRecords(records, MakeAnalysisOptions(config, options));
  RequireUsable(config, records, set);
  std::vector<UsableRecord> out;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const Characteristics& c = set.analyses[e].characteristics;
    out.push_back({std::move(records[e]), CycleOf(set.analyses[e]),
                   c.state == CycleState::kNoLimitCycle ? 0.0 : c.p_amplitude});
  }
  return out;
}

std::vector<LoopRecord> LoopRecordsOf(std::vector<UsableRecord> records) {
  std::vector<LoopRecord> out;
  for (UsableRecord& each : records) {
    NamedRecord& of = each.record;
    out.push_back({std::move(of.name), of.phi, each.cycle_hz, std::move(of.record)});
  }
  return out;
}

std::optional<std::size_t> StatedStarts(const Config& config) {
  const LocatedMember* const solver = config.tree.Find("solver");
  if (solver == nullptr || solver->value.Find("starts") == nullptr) return std::nullopt;
  return static_cast<std::size_t>(config.solver.starts);
}

}  // namespace howl
