// What the results of a config depend on beside the options and the program.
#ifndef HOWL_APP_JOBS_CONFIG_INPUTS_H_
#define HOWL_APP_JOBS_CONFIG_INPUTS_H_

#include <string>

#include "io/config/config.h"

namespace howl {

// SHA-256 of the config's text, of its records, and of its tables of instruments.
std::string ConfigInputsSha256(const Config& config);

}  // namespace howl

#endif  // HOWL_APP_JOBS_CONFIG_INPUTS_H_
