// howl predict where the config's model is a loop that records alone can show
// (Config::record_loop).
#ifndef HOWL_APP_FAMILY_RECORD_PREDICT_RUN_H_
#define HOWL_APP_FAMILY_RECORD_PREDICT_RUN_H_

#include "app/command_line/options.h"
#include "io/config/config.h"

namespace howl {

// Predicts, prints and writes; the command's exit status. Throws UsageError for --map and
// --without, which are of a family.
int RunRecordPrediction(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_FAMILY_RECORD_PREDICT_RUN_H_
