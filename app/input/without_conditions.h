// `--without loop_gain_min`: the family without a condition of its test, as `test: {NAME: null}`
// in the config has it, for those who do not write to the config.
#ifndef HOWL_APP_INPUT_WITHOUT_CONDITIONS_H_
#define HOWL_APP_INPUT_WITHOUT_CONDITIONS_H_

#include "app/command_line/options.h"
#include "io/config/config.h"

namespace howl {

OptionHelp WithoutOption();

// The config with the conditions of --without switched off. Throws UsageError for a name that is
// none.
Config WithoutConditions(Config config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_INPUT_WITHOUT_CONDITIONS_H_
