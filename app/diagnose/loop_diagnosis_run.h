// howl diagnose of records: what the config's loop, or the paper's, lacks (loop_budget.h).
#ifndef HOWL_APP_DIAGNOSE_LOOP_DIAGNOSIS_RUN_H_
#define HOWL_APP_DIAGNOSE_LOOP_DIAGNOSIS_RUN_H_

#include <vector>

#include "app/command_line/options.h"
#include "app/input/record_input.h"
#include "io/config/config.h"

namespace howl {

// Of the config's records. The exit status.
int RunLoopDiagnosis(const Config& config, const Options& options, std::vector<NamedRecord> read);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_LOOP_DIAGNOSIS_RUN_H_
