#include "io/config/config_sections.h"

namespace howl {

void ReadSimulation(const ConfigCursor& root, Config& config) {
  const auto simulation = root.Find("simulate");
  if (!simulation) return;
  SimulationSpec& spec = config.simulation;
  simulation->Read("duration_s", spec.duration_s);
  simulation->Read("sampling_hz", spec.sampling_hz);
  simulation->Read("settle_s", spec.settle_s);
  if (const auto shape = simulation->Find("flame_shape")) {
    for (const FlameShape each : kFlameShapes) {
      if (shape->Node().text == FlameShapeName(each)) spec.flame_shape = each;
    }
  }
  simulation->Read("saturation", spec.saturation);
  spec.flame_is_given = simulation->Find("flame_shape") || simulation->Find("saturation");
  simulation->Read("combustion_noise_relative", spec.combustion_noise_relative);
  simulation->Read("combustion_noise_corner_hz", spec.combustion_noise_corner_hz);
  simulation->Read("sensor_noise_relative", spec.sensor_noise_relative);
  simulation->Read("loop_gain_min", spec.loop_gain_min);
}

}  // namespace howl
