// What a config and the options ask of the search for one cause (diagnosis.h), without what is
// asked for besides it: a reference, replicates, a memory.
#ifndef HOWL_APP_DIAGNOSE_SEARCH_OPTIONS_H_
#define HOWL_APP_DIAGNOSE_SEARCH_OPTIONS_H_

#include "app/command_line/command.h"
#include "diagnosis/search/diagnosis_options.h"
#include "io/config/config.h"

namespace howl {

// Throws UsageError for effects to be left out that there are not.
DiagnosisOptions SearchOptions(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_SEARCH_OPTIONS_H_
