// The start of a simulation by the config's simulate.start and simulate.start_frequency_hz.
#ifndef HOWL_APP_SIMULATE_SIMULATE_START_H_
#define HOWL_APP_SIMULATE_SIMULATE_START_H_

#include <optional>
#include <string>

#include "estimation/analysis/loop/experiment.h"
#include "io/config/config.h"
#include "model/cycles/harmonic_balance.h"

namespace howl {

// The cycle nearest to the one that was observed; no value where the loop has none.
std::optional<LimitCycle> ObservedCycle(const ClosedLoop& model, double frequency_hz);

struct SimulationOrigin {
  std::optional<LimitCycle> cycle;  // none: at rest
  std::string text;                 // "on the cycle at 750.3 Hz"
};

// Throws UserError at the config's line where the loop has no such cycle.
SimulationOrigin FindOrigin(const Config& config, const Experiment& experiment,
                            const ClosedLoop& model, const std::optional<LimitCycle>& observed);

// All cycles of the loop near the modes' frequencies or that of the experiment, in order of
// frequency.
std::vector<LimitCycle> CyclesOfInterest(const ClosedLoop& model, double frequency_hz);

}  // namespace howl

#endif  // HOWL_APP_SIMULATE_SIMULATE_START_H_
