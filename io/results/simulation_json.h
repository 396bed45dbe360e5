// simulation.json, schema howl.simulation/1: which loops `howl simulate` ran, so that whoever shows
// the records can say so. What effects were put in it does not tell, like records.yaml.
//
//   {"schema": "howl.simulation/1", "member": null | K,
//    "experiments": [{"name", "loop_gain", "loop_gain_simulated", "flame_slope", "slope_raised",
//                     "flame": {"shape", "saturation", "offset"}, "cycle_hz": number | null}]}
//
// flame_slope is Phi'(0); flame.offset in (units of p) / s (model/loop/flame.h). cycle_hz: of the
// cycle on which the record begins, by harmonic balance; null where it begins at rest.
#ifndef HOWL_IO_RESULTS_SIMULATION_JSON_H_
#define HOWL_IO_RESULTS_SIMULATION_JSON_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "model/loop/flame.h"

namespace howl {

struct SimulatedLoop {
  std::string name;
  double loop_gain = 0.0;            // the model's with the measured slope; 0 where none was
  double simulated_loop_gain = 0.0;  // at rest, as it ran
  double flame_slope = 0.0;          // as it ran, (units of q) / (units of p / s)
  bool slope_raised = false;         // to simulate.loop_gain_min: the model alone would not cycle
  Flame<double> flame;
  std::optional<double> cycle_hz;
};

// `member`: of family.csv; none for the joint fit.
nlohmann::ordered_json SimulationJson(std::optional<int> member,
                                      std::span<const SimulatedLoop> loops);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_SIMULATION_JSON_H_
