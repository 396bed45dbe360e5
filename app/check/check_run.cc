#include "app/check/check_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/check/check_abilities.h"
#include "app/input/record_input.h"
#include "app/text/text_table.h"
#include "estimation/health/analysis_health.h"
#include "estimation/health/gain_health.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/records/record_faults.h"

namespace howl {
namespace {

// Takes the experiments whose records cannot be read out of the config.
std::vector<NamedRecord> TakeRecords(Config& config, CheckReport& report) {
  std::vector<NamedRecord> records;
  std::vector<ExperimentConfig> good;
  for (ExperimentConfig& each : config.experiments) {
    if (each.record) {
      RecordReading reading = ReadRecordOn(*each.record, config.source.string(), each.record_line);
      std::ranges::move(reading.faults, std::back_inserter(report.errors));
      if (!reading.record) continue;
      Append(CheckRecordedSamples(each, config, *reading.record), report.warnings);
      records.push_back(
          {each.experiment.name, each.experiment.phi, *std::move(reading.record), each.cycle_hz});
    }
    good.push_back(std::move(each));
  }
  config.experiments = std::move(good);
  return records;
}

void WarnOfTwins(const std::vector<NamedRecord>& records, Health& warnings) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (records[i].record.pressure != records[j].record.pressure) continue;
      warnings.push_back({FindingKind::kSetup, records[i].name, "same_record", std::nan(""),
                          std::nan(""),
                          records[i].name + ": has the same samples of p as " + records[j].name});
    }
  }
}

void WarnOfEqualPoints(const Config& config, Health& warnings) {
  const std::vector<ExperimentConfig>& all = config.experiments;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto same = std::find_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const ExperimentConfig& other) {
                                     return other.experiment.phi == all[i].experiment.phi;
                                   });
    if (same == all.begin() + static_cast<std::ptrdiff_t>(i)) continue;
    const double phi = all[i].experiment.phi;
    warnings.push_back({FindingKind::kSetup, all[i].experiment.name, "same_operating_point", phi,
                        same->experiment.phi,
                        all[i].experiment.name + ": has the same " + config.operating_parameter +
                            " as " + same->experiment.name + ", " + Significant(phi, 4) +
                            ": repeats of one operating point, or one of the two is mistyped"});
  }
}

std::vector<CheckedExperiment> Rows(const Config& config, const ProblemInput& input,
                                    bool points_are_known) {
  std::vector<CheckedExperiment> rows;
  std::size_t next = 0;
  for (const ExperimentConfig& each : config.experiments) {
    CheckedExperiment& row = rows.emplace_back();
    row.name = each.experiment.name;
    if (points_are_known) row.phi = each.experiment.phi;
    row.has_record = each.record.has_value();
    row.frequency_hz = each.experiment.frequency_hz;
    if (!row.has_record) continue;
    const Record& record = input.records[next].record;
    const Analysis& analysis = input.analysis->analyses[next++];
    row.has_heat_release = !record.heat_release.empty();
    row.samples = record.pressure.size();
    row.sampling_hz = record.sampling_hz;
    row.duration_s = static_cast<double>(row.samples) / record.sampling_hz;
    const Characteristics& cycle = analysis.characteristics;
    row.state = std::string(CycleStateName(cycle.state));
    row.frequency_hz =
        cycle.state == CycleState::kNoLimitCycle ? std::nan("") : cycle.frequency_hz.value;
  }
  return rows;
}

}  // namespace

CheckReport RunCheck(const Options& options) {
  CheckReport report;
  report.config = options.config.string();
  ConfigReading reading = ReadConfigOn(options.config);
  report.errors = std::move(reading.mistakes);
  report.experiments = reading.experiments;
  if (!reading.config) return report;
  Config& config = *reading.config;
  report.operating_parameter = config.operating_parameter;
  std::vector<NamedRecord> records = TakeRecords(config, report);
  WarnOfTwins(records, report.warnings);
  if (reading.points_are_known) WarnOfEqualPoints(config, report.warnings);
  if (config.experiments.empty()) return report;
  const ProblemInput input = AnalyseInput(config, options, std::move(records));
  report.rows = Rows(config, input, reading.points_are_known);
  if (input.analysis) {
    Append(CheckAnalysis(input.records, *input.analysis, MakeAnalysisOptions(config, options),
                         RateSources(config)),
           report.warnings);
  } else {
    Append(CheckGains(input.experiments), report.warnings);
  }
  report.abilities = FindAbilities(config, options, input, reading.points_are_known);
  return report;
}

}  // namespace howl
