// howl simulate where the config's model is a loop that records alone can show
// (Config::record_loop): records of the loop that the fit finds at each operating point.
#ifndef HOWL_APP_SIMULATE_RECORD_SIMULATION_H_
#define HOWL_APP_SIMULATE_RECORD_SIMULATION_H_

#include "app/command_line/options.h"
#include "io/config/config.h"

namespace howl {

// Simulates, prints and writes; the command's exit status. Throws UserError where `simulate` has a
// key that such a loop does not take.
int RunRecordSimulation(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_RECORD_SIMULATION_H_
