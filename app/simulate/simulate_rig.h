// The loop of one experiment as `howl simulate` runs it: the model's acoustics and delay, closed by
// a flame that saturates, with noise and the config's effects.
#ifndef HOWL_APP_SIMULATE_SIMULATE_RIG_H_
#define HOWL_APP_SIMULATE_SIMULATE_RIG_H_

#include <optional>
#include <string>
#include <vector>

#include "estimation/analysis/flame/flame_shape.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "io/config/config.h"
#include "model/cycles/harmonic_balance.h"
#include "model/simulation/simulate.h"

namespace howl {

struct SimulatedRig {
  RigParameters parameters;
  Flame<double> flame;           // as it runs, without effects
  bool has_flame_table = false;  // in the flame's place; `flame` is the shape nearest to it
  double flame_slope = 0.0;      // at rest
  double loop_gain = 0.0;        // at rest, as it runs
  double model_loop_gain = 0.0;  // with the measured slope
  bool slope_raised = false;
  std::optional<LimitCycle> cycle;  // on which it starts; none: at rest
  std::string origin;               // "on the cycle at 219.9 Hz"
  double pressure_amplitude = 0.0;  // of the observed cycle; saturation's where there is none
  double heat_release_amplitude = 0.0;
};

// measured: the shape of the experiment's own flame; where there is none, or the config's
// `simulate` names one, the config's.
SimulatedRig MakeRig(const Config& config, const Experiment& experiment, const LoopModel& model,
                     const std::optional<FlameShapeFit>& measured, const SimulationTimes& times);

// The config's effects and sources of noise, relative to the cycles that the rigs have without
// them.
void AddEffects(const Config& config, const std::vector<Experiment>& experiments, double duration_s,
                std::vector<SimulatedRig>* rigs);

// A note where a rig that began on a cycle is found at another frequency: "its strongest line is at
// 776.0 Hz, not at the cycle's 224.0 Hz"; else empty.
std::string LeftItsCycle(const SimulatedRig& rig, const SimulatedRecord& record);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_SIMULATE_RIG_H_
