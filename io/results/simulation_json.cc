#include "io/results/simulation_json.h"

#include "io/config/simulation_spec.h"

namespace howl {

using Json = nlohmann::ordered_json;

Json SimulationJson(std::optional<int> member, std::span<const SimulatedLoop> loops) {
  Json experiments = Json::array();
  for (const SimulatedLoop& loop : loops) {
    experiments.push_back({{"name", loop.name},
                           {"loop_gain", loop.loop_gain},
                           {"loop_gain_simulated", loop.simulated_loop_gain},
                           {"flame_slope", loop.flame_slope},
                           {"slope_raised", loop.slope_raised},
                           {"flame",
                            {{"shape", FlameShapeName(loop.flame.shape)},
                             {"saturation", loop.flame.saturation},
                             {"offset", loop.flame.offset}}},
                           {"cycle_hz", loop.cycle_hz ? Json(*loop.cycle_hz) : Json(nullptr)}});
  }
  return {{"schema", "howl.simulation/1"},
          {"member", member ? Json(*member) : Json(nullptr)},
          {"experiments", experiments}};
}

}  // namespace howl
