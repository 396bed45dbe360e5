// The records of rigs that are simulated together: one case an experiment, with noise of its own by
// the experiment's name, for the config's times.
#ifndef HOWL_APP_SIMULATE_SIMULATE_CASES_H_
#define HOWL_APP_SIMULATE_SIMULATE_CASES_H_

#include <cstdint>
#include <vector>

#include "app/simulate/simulate_rig.h"

namespace howl {

// Throws UserError where CheckInternalRate does (app/simulate/simulate_times.h).
std::vector<SimulationCase> CasesOf(const Config& config, const SimulationTimes& times,
                                    const std::vector<Experiment>& experiments,
                                    const std::vector<SimulatedRig>& rigs, std::uint64_t seed);

std::vector<SimulatedRecord> SimulateCases(const std::vector<SimulationCase>& cases,
                                           const SimulationTimes& times, int threads);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_SIMULATE_CASES_H_
