// Noise of a rig by where it enters, beyond the combustion and sensor noise of model/noise/noise.h:
//
//   combustion            added to q inside the loop: q = Phi + n, and the acoustics feel it
//   duct                  drives the acoustics as heat release would, and q does not show it:
//                         p = G (q + d)
//   pressure_sensor       added to the recorded p
//   heat_release_sensor   added to the recorded q
//   background            one process, added to both recorded channels: mains, a common ground
//
// In the loop the process runs at the internal rate; added to a record, at the record's rate, past
// the anti-alias filter. A source with std zero changes no bit.
#ifndef HOWL_MODEL_SIMULATION_NOISE_SOURCE_H_
#define HOWL_MODEL_SIMULATION_NOISE_SOURCE_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "model/noise/noise_process.h"
#include "model/simulation/simulate.h"

namespace howl {

enum class NoisePlace : std::uint8_t {
  kCombustion,
  kDuct,
  kPressureSensor,
  kHeatReleaseSensor,
  kBackground
};
inline constexpr std::array kNoisePlaces = {
    NoisePlace::kCombustion, NoisePlace::kDuct, NoisePlace::kPressureSensor,
    NoisePlace::kHeatReleaseSensor, NoisePlace::kBackground};
constexpr std::string_view NoisePlaceName(NoisePlace place) {
  constexpr std::array<std::string_view, kNoisePlaces.size()> kNames = {
      "combustion", "duct", "pressure_sensor", "heat_release_sensor", "background"};
  return kNames[static_cast<std::size_t>(place)];
}

struct NoiseSource {
  NoisePlace place = NoisePlace::kCombustion;
  NoiseSpectrum spectrum;
  double pressure_std = 0.0;      // units of p: of a sensor's, and the background's part in p
  double heat_release_std = 0.0;  // units of q: of all but the pressure sensor's
};

// In the loop noise must have a band: white there is a fault of the caller.
void AddNoiseSource(const NoiseSource& source, RigParameters* rig);

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_NOISE_SOURCE_H_
