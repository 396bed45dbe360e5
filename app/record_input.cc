#include "app/record_input.h"

#include "io/records/records.h"
#include "io/records/time_unit.h"

namespace howl {

std::vector<NamedRecord> LoadRecords(const Config& config) {
  std::vector<NamedRecord> records;
  for (const ExperimentConfig& each : config.experiments) {
    if (!each.record) continue;
    records.push_back({each.experiment.name, each.experiment.phi,
                       LoadRecord(*each.record, config.source.string(), each.record_line)});
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

AnalysisOptions MakeAnalysisOptions(const Config& config, const Options& options) {
  AnalysisOptions analysis;
  analysis.characteristics.method = config.analysis.method;
  analysis.characteristics.min_frequency_hz = config.analysis.min_frequency_hz.value_or(0.0);
  analysis.characteristics.max_frequency_hz = config.analysis.max_frequency_hz.value_or(0.0);
  analysis.transfer.min_frequency_hz = config.analysis.min_frequency_hz.value_or(0.0);
  analysis.transfer.max_frequency_hz = config.analysis.max_frequency_hz.value_or(0.0);
  if (config.analysis.method == CharacteristicsMethod::kSeed) analysis.flame_curve.max_harmonic = 1;
  analysis.delay_branch = config.analysis.delay_branch;
  analysis.model = config.model;
  analysis.second_mode_share_max = config.family.test.second_mode_share_max;
  analysis.threads = options.threads;
  return analysis;
}

}  // namespace howl
