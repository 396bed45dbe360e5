// `simulate: {flame_table: true}`: the measured curve itself as a rig's flame.
#ifndef HOWL_APP_SIMULATE_FLAME_TABLE_RIG_H_
#define HOWL_APP_SIMULATE_FLAME_TABLE_RIG_H_

#include "app/input/problem_input.h"
#include "app/simulate/simulate_rig.h"

namespace howl {

// Before the config's effects are added. The rig starts on the cycle of the nearest shape, which is
// near to the table's. Throws UserError for an experiment whose record gave no curve.
void UseFlameTable(const Config& config, const ProblemInput& input, const Experiment& experiment,
                   SimulatedRig* rig);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_FLAME_TABLE_RIG_H_
