// Whether `howl simulate` can run with the times that the config asks for.
#ifndef HOWL_APP_SIMULATE_SIMULATE_TIMES_H_
#define HOWL_APP_SIMULATE_SIMULATE_TIMES_H_

#include <span>

#include "estimation/analysis/loop/experiment.h"
#include "io/config/config.h"
#include "model/simulation/simulate.h"

namespace howl {

// Throws UserError, naming the key, when the records cannot show the cycles (the sampling rate is
// not above twice their frequency: Nyquist), have too few samples to be read back, or do not fit
// into the memory.
void CheckSimulationTimes(const Config& config, const SimulationTimes& times,
                          std::span<const Experiment> experiments);

// Throws UserError when the rig takes more steps than are counted, or than anyone waits for.
void CheckInternalRate(const Config& config, const SimulationTimes& times,
                       const Experiment& experiment, const RigParameters& rig);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_SIMULATE_TIMES_H_
