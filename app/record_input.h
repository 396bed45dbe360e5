// From a config's records to analyses: the samples are read, then analysed together.
#ifndef HOWL_APP_RECORD_INPUT_H_
#define HOWL_APP_RECORD_INPUT_H_

#include <vector>

#include "app/options.h"
#include "estimation/analysis/analyse.h"
#include "estimation/health/analysis_health.h"
#include "io/config/config.h"

namespace howl {

// The experiments that have a record, in the config's order. Throws UserError for bad data.
std::vector<NamedRecord> LoadRecords(const Config& config);

// Of each experiment that has a record: whether a number gives its sampling rate, or the steps of
// its time column.
std::vector<RateSource> RateSources(const Config& config);

AnalysisOptions MakeAnalysisOptions(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_RECORD_INPUT_H_
