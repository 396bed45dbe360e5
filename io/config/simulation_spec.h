// The config's `simulate:`: what `howl simulate` needs in addition to the fitted loop.
#ifndef HOWL_IO_CONFIG_SIMULATION_SPEC_H_
#define HOWL_IO_CONFIG_SIMULATION_SPEC_H_

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "model/effects/effect.h"
#include "model/loop/flame_shapes.h"
#include "model/simulation/noise_source.h"
#include "model/simulation/sweep.h"

namespace howl {

// An effect of the catalogue that the simulated rig has.
struct SimulatedEffect {
  std::shared_ptr<const Effect> effect;
  std::vector<double> values;  // in the order of its parameters; nulls where not given
  int line = 0;
  std::string key;  // of the config
};

// A source of noise beyond the combustion and sensor noise that every simulation has.
struct SimulatedNoise {
  NoisePlace place = NoisePlace::kCombustion;
  // Over the flame's saturation in the loop, over the cycle's amplitude in a recorded channel.
  double rms_relative = 0.0;
  NoiseSpectrum spectrum;
};
inline constexpr double kDefaultNoiseDamping = 0.1;  // of a resonance

// The state in which a simulation starts.
enum class SimulationStart : std::uint8_t { kObservedCycle, kUpperCycle, kRest };
inline constexpr std::array kSimulationStarts = {
    SimulationStart::kObservedCycle, SimulationStart::kUpperCycle, SimulationStart::kRest};
constexpr std::string_view SimulationStartName(SimulationStart start) {
  constexpr std::array<std::string_view, kSimulationStarts.size()> kNames = {"observed", "upper",
                                                                             "rest"};
  return kNames[static_cast<std::size_t>(start)];
}

struct SweepSpec {
  SweptParameter parameter = SweptParameter::kMOverN;
  double from = 0.0;
  double to = 0.0;
  double one_way_s = 40.0;
  int steps = 50;
  std::optional<double> combustion_noise_relative;  // none: the simulation's
  int line = 0;
};

struct SimulationSpec {
  std::optional<double> duration_s;
  std::optional<double> sampling_hz;
  std::optional<double> settle_s;  // run and thrown away first
  FlameShape flame_shape = FlameShape::kTanh;
  double saturation = 1.0;                  // of the heat release, in units of q
  bool flame_is_given = false;              // by the config: shape or saturation
  bool flame_table = false;                 // the measured curve itself, point by point
  double combustion_noise_relative = 0.01;  // rms over saturation
  std::optional<double> combustion_noise_corner_hz;
  double sensor_noise_relative = 0.001;  // rms over the cycle's amplitude, in each channel
  // A measured experiment was in a limit cycle, so (1b) holds: a flame slope that gives less loop
  // gain than this is raised to it.
  double loop_gain_min = 1.1;
  SimulationStart start = SimulationStart::kObservedCycle;
  std::optional<double> start_frequency_hz;  // the cycle nearest to it
  int start_line = 0;
  std::optional<SweepSpec> sweep;
  std::vector<SimulatedEffect> effects;
  std::vector<SimulatedNoise> noise;
};

// Times that the config does not state follow the cycle (model/simulation/cycle_scale.h): the
// number of periods, and of samples in a period, is the same whatever its frequency.
struct SimulationTimes {
  double duration_s = 3.2;  // the paper's 16 000 samples at 5 kHz, of a cycle at 220 Hz
  double sampling_hz = 5000.0;
  double settle_s = 1.0;
  double combustion_noise_corner_hz = 500.0;
};

SimulationTimes MakeSimulationTimes(const SimulationSpec& spec,
                                    std::span<const Experiment> experiments);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SIMULATION_SPEC_H_
