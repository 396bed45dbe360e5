// From a config's records to analyses: the samples are read, then analysed together.
#ifndef HOWL_APP_INPUT_RECORD_INPUT_H_
#define HOWL_APP_INPUT_RECORD_INPUT_H_

#include <span>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "estimation/analysis/analyse.h"
#include "estimation/health/analysis_health.h"
#include "io/config/config.h"

namespace howl {

// The experiments that have a record, in the config's order. Throws UserError for bad data.
std::vector<NamedRecord> LoadRecords(const Config& config);

// Of the config's experiments the one with this name, which one of them has.
const ExperimentConfig& ExperimentNamed(const Config& config, const std::string& name);

// Of each experiment that has a record: whether a number gives its sampling rate, or the steps of
// its time column.
std::vector<RateSource> RateSources(const Config& config);

// What the samples of one experiment's record show of its instruments, before what is known of them
// is taken out. `record`: as LoadRecords has it.
Health CheckRecordedSamples(const ExperimentConfig& experiment, const Config& config,
                            const Record& record);

// The samples of every record, then their analysis. `records`: LoadRecords of this config.
Health CheckRecords(const Config& config, std::span<const NamedRecord> records,
                    const AnalysisSet& set, const AnalysisOptions& options);

AnalysisOptions MakeAnalysisOptions(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_INPUT_RECORD_INPUT_H_
