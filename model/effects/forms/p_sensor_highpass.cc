#include "model/effects/forms/sensor_highpass.h"

namespace howl {

std::vector<EffectPointer> PSensorHighPass(const CatalogueBase& /*base*/) {
  return {std::make_shared<SensorHighPass>("p_sensor_highpass", Channel::kPressure)};
}

}  // namespace howl
