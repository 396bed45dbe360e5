// howl fit where the config's model is a loop that records alone can show (Config::record_loop).
#ifndef HOWL_APP_FIT_RECORD_FIT_RUN_H_
#define HOWL_APP_FIT_RECORD_FIT_RUN_H_

#include "app/command_line/options.h"
#include "io/config/config.h"

namespace howl {

// Fits, prints and writes solution.json; the command's exit status. Throws UserError where an
// experiment has no record of both signals.
int RunRecordFit(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_FIT_RECORD_FIT_RUN_H_
