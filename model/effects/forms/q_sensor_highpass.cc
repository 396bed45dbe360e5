#include "model/effects/forms/sensor_highpass.h"

namespace howl {

std::vector<EffectPointer> QSensorHighPass(const CatalogueBase& /*base*/) {
  return {std::make_shared<SensorHighPass>("q_sensor_highpass", Channel::kHeatRelease)};
}

}  // namespace howl
