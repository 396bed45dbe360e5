// The rigs of all experiments, each with its own measured flame (simulate_rig.h), or with the table
// of that flame where the config asks for it (flame_table_rig.h).
#ifndef HOWL_APP_SIMULATE_SIMULATE_RIGS_H_
#define HOWL_APP_SIMULATE_SIMULATE_RIGS_H_

#include <vector>

#include "app/input/problem_input.h"
#include "app/simulate/simulate_rig.h"

namespace howl {

// models: one for each of the input's experiments.
std::vector<SimulatedRig> MakeRigs(const Config& config, const ProblemInput& input,
                                   const std::vector<LoopModel>& models,
                                   const SimulationTimes& times);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_SIMULATE_RIGS_H_
