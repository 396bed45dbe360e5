// The config's simulate.sweep: a parameter goes there and back in one run of each rig. Reported are
// the values at which the rig jumps, and those at which both cycles attract by harmonic balance.
#ifndef HOWL_APP_SIMULATE_SIMULATE_SWEEP_H_
#define HOWL_APP_SIMULATE_SIMULATE_SWEEP_H_

#include <optional>
#include <string>
#include <vector>

#include "io/config/config.h"
#include "model/simulation/simulate.h"
#include "model/simulation/sweep.h"

namespace howl {

struct SweptRig {
  std::string name;  // of the experiment
  SimulationCase start;
  double frequency_hz = 0.0;  // of the experiment
};

struct SweepResult {
  std::string name;
  std::vector<SweepWindow> windows;
  std::vector<SweepJump> jumps;
  std::vector<ParameterInterval> hysteresis;
  // Where the cycle of the sweep's start and the one at its far end both attract; none where they
  // are one cycle, or could not be followed.
  std::optional<ParameterInterval> coexist;
};

// Throws UserError where the sweep's windows are too short to tell one line from another.
void CheckSweep(const Config& config, const SimulationTimes& times);

// `sweep` was asked for. The runs take units of their own, on `threads`.
std::vector<SweepResult> RunSweeps(const Config& config, const SimulationTimes& times,
                                   std::vector<SweptRig> rigs, int threads);

// experiment,direction,parameter,value,frequency_hz,p_amplitude; direction: up or down.
std::string SweepCsv(const SweepSpec& sweep, const std::vector<SweepResult>& results);
std::string SweepText(const SweepSpec& sweep, const std::vector<SweepResult>& results);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_SIMULATE_SWEEP_H_
