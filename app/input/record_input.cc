#include "app/input/record_input.h"

#include <glog/logging.h>

#include <algorithm>

#include "estimation/health/sample_health.h"
#include "io/records/columns/time_unit.h"
#include "io/records/record_faults.h"
#include "io/records/records.h"

namespace howl {
namespace {

// The record before known instruments are removed from it, because a filter moves the samples that
// were at the converter's end.
Record AsRecorded(const RecordSpec& spec, const Config& config, int line, const Record& record) {
  if (!spec.HasInstruments()) return record;
  RecordSpec plain = spec;
  plain.ForgetInstruments();
  return ReadRecordOn(plain, config.source.string(), line).record.value_or(record);
}

}  // namespace

const ExperimentConfig& ExperimentNamed(const Config& config, const std::string& name) {
  return *std::ranges::find_if(config.experiments, [&](const ExperimentConfig& each) {
    return each.experiment.name == name;
  });
}

std::vector<NamedRecord> LoadRecords(const Config& config) {
  std::vector<NamedRecord> records;
  for (const ExperimentConfig& each : config.experiments) {
    if (!each.record) continue;
    records.push_back({each.experiment.name, each.experiment.phi,
                       LoadRecord(*each.record, config.source.string(), each.record_line),
                       each.cycle_hz});
  }
  return records;
}

std::vector<RateSource> RateSources(const Config& config) {
  std::vector<RateSource> sources;
  for (const ExperimentConfig& each : config.experiments) {
    if (!each.record) continue;
    // A name with a unit leaves nothing to guess.
    const bool by_times = each.record->time && !each.record->time_unit_s &&
                          !each.record->sampling_hz && !TimeUnitOfName(*each.record->time);
    sources.push_back(by_times ? RateSource::kTimeColumn : RateSource::kNumber);
  }
  return sources;
}

Health CheckRecordedSamples(const ExperimentConfig& experiment, const Config& config,
                            const Record& record) {
  const Record raw = AsRecorded(*experiment.record, config, experiment.record_line, record);
  Health health = CheckSamples(experiment.experiment.name, "p", raw.pressure, raw.sampling_hz);
  Append(CheckSamples(experiment.experiment.name, "q", raw.heat_release, raw.sampling_hz), health);
  return health;
}

Health CheckRecords(const Config& config, std::span<const NamedRecord> records,
                    const AnalysisSet& set, const AnalysisOptions& options) {
  Health health;
  auto record = records.begin();
  for (const ExperimentConfig& each : config.experiments) {
    if (!each.record) continue;
    CHECK(record != records.end() && record->name == each.experiment.name);
    Append(CheckRecordedSamples(each, config, record->record), health);
    ++record;
  }
  Append(CheckAnalysis(records, set, options, RateSources(config)), health);
  return health;
}

AnalysisOptions MakeAnalysisOptions(const Config& config, const Options& options) {
  AnalysisOptions analysis;
  analysis.characteristics.method = config.analysis.method;
  analysis.characteristics.min_frequency_hz = config.analysis.min_frequency_hz.value_or(0.0);
  analysis.characteristics.max_frequency_hz = config.analysis.max_frequency_hz.value_or(0.0);
  analysis.transfer.min_frequency_hz = config.analysis.min_frequency_hz.value_or(0.0);
  analysis.transfer.max_frequency_hz = config.analysis.max_frequency_hz.value_or(0.0);
  if (config.analysis.method == CharacteristicsMethod::kPaper)
    analysis.flame_curve.max_harmonic = 1;
  analysis.delay_branch = config.analysis.delay_branch;
  analysis.model = config.model;
  analysis.second_mode_share_max = config.family.test.second_mode_share_max;
  analysis.threads = options.threads;
  return analysis;
}

}  // namespace howl
