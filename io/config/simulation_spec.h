// The config's `simulate:`: what `howl simulate` needs beyond the fitted loop.
#ifndef HOWL_IO_CONFIG_SIMULATION_SPEC_H_
#define HOWL_IO_CONFIG_SIMULATION_SPEC_H_

#include <array>
#include <string_view>

#include "model/flame.h"

namespace howl {

inline constexpr std::array kFlameShapes = {FlameShape::kTanh, FlameShape::kArctan,
                                            FlameShape::kCubic, FlameShape::kPiecewiseLinear,
                                            FlameShape::kAlgebraic};

// As in configs.
constexpr std::string_view FlameShapeName(FlameShape shape) {
  constexpr std::array<std::string_view, kFlameShapes.size()> kNames = {
      "tanh", "arctan", "cubic", "piecewise_linear", "algebraic"};
  return kNames[static_cast<std::size_t>(shape)];
}

struct SimulationSpec {
  double duration_s = 3.2;  // the seed's 16 000 samples at 5 kHz
  double sampling_hz = 5000.0;
  double settle_s = 1.0;  // run and thrown away first
  FlameShape flame_shape = FlameShape::kTanh;
  double saturation = 1.0;                  // of the heat release, in units of q
  bool flame_is_given = false;              // by the config: shape or saturation
  double combustion_noise_relative = 0.01;  // rms over saturation
  double combustion_noise_corner_hz = 500.0;
  double sensor_noise_relative = 0.001;  // rms over the cycle's amplitude, in each channel
  // An experiment was seen in a limit cycle, so (1b) holds: a flame slope that gives less loop gain
  // than this is raised to it.
  double loop_gain_min = 1.1;
};

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SIMULATION_SPEC_H_
