// simulation.json, schema howl.simulation/1 (simulation_json.h), of loops that were fitted to whole
// records. Each experiment's flame has the shape "spline" and its curve, q over v at some points
// over the range that the record reached; further keys are
//
//   "flame_input", "tau_s", "modes": [{"omega_hz", "xi", "N", "B"}], "leak_hz": of p's integral
#ifndef HOWL_IO_RESULTS_RECORD_SIMULATION_JSON_H_
#define HOWL_IO_RESULTS_RECORD_SIMULATION_JSON_H_

#include <nlohmann/json.hpp>
#include <span>

#include "io/results/record_solution_json.h"
#include "model/simulation/simulate_modal.h"

namespace howl {

// rigs: one for each of the solution's experiments.
nlohmann::ordered_json RecordSimulationJson(const RecordSolution& solution,
                                            std::span<const ModalRig> rigs);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_RECORD_SIMULATION_JSON_H_
