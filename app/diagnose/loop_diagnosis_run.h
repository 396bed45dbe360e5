// howl diagnose where the config's model is a loop that records alone can show
// (Config::record_loop).
#ifndef HOWL_APP_DIAGNOSE_LOOP_DIAGNOSIS_RUN_H_
#define HOWL_APP_DIAGNOSE_LOOP_DIAGNOSIS_RUN_H_

#include "app/command_line/options.h"
#include "io/config/config.h"

namespace howl {

// The exit status.
int RunLoopDiagnosis(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_LOOP_DIAGNOSIS_RUN_H_
