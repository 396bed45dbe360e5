#include "app/simulate/simulate_rigs.h"

#include "app/input/measured_flame.h"
#include "app/simulate/flame_table_rig.h"

namespace howl {

std::vector<SimulatedRig> MakeRigs(const Config& config, const ProblemInput& input,
                                   const std::vector<LoopModel>& models,
                                   const SimulationTimes& times) {
  std::vector<SimulatedRig> rigs;
  for (std::size_t i = 0; i < input.experiments.size(); ++i) {
    const Experiment& experiment = input.experiments[i];
    rigs.push_back(MakeRig(config, experiment, models[i], MeasuredFlame(input, experiment), times));
    if (config.simulation.flame_table) UseFlameTable(config, input, experiment, &rigs.back());
  }
  return rigs;
}

}  // namespace howl
