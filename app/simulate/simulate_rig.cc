#include "app/simulate/simulate_rig.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "app/simulate/simulate_start.h"
#include "app/text/text_table.h"
#include "estimation/analysis/spectra/spectrum.h"
#include "io/user_error.h"

namespace howl {
namespace {

// Noise and harmonics pull a cycle's frequency by a few parts in a thousand; another mode's cycle
// lies farther off by far.
constexpr double kSameCycle = 0.1;

// Amplitude of p' at the cycle.
double Rate(const SimulatedRig& rig, const Experiment& experiment) {
  return kRadPerSPerHz * experiment.frequency_hz * rig.pressure_amplitude;
}

// In the loop, or on the record: the latter come before what digitises, and the former after the
// effects, whose random streams no source of noise moves.
void AddNoise(const std::vector<SimulatedNoise>& sources, bool in_loop, SimulatedRig* rig) {
  for (const SimulatedNoise& one : sources) {
    const bool enters_loop = one.place == NoisePlace::kCombustion || one.place == NoisePlace::kDuct;
    if (enters_loop != in_loop) continue;
    NoiseSource source{one.place, one.spectrum};
    if (in_loop) {
      source.heat_release_std = one.rms_relative * rig->flame.saturation;
    } else {
      if (one.place != NoisePlace::kHeatReleaseSensor) {
        source.pressure_std = one.rms_relative * rig->pressure_amplitude;
      }
      if (one.place != NoisePlace::kPressureSensor) {
        source.heat_release_std = one.rms_relative * rig->heat_release_amplitude;
      }
    }
    AddNoiseSource(source, &rig->parameters);
  }
}

}  // namespace

SimulatedRig MakeRig(const Config& config, const Experiment& experiment, const LoopModel& model,
                     const std::optional<FlameShapeFit>& measured, const SimulationTimes& times) {
  const SimulationSpec& spec = config.simulation;
  SimulatedRig rig;
  const LoopParameters<double> loop = model.Loop();
  const double response = Magnitude(LoopResponse(loop, experiment.frequency_hz));
  double slope = experiment.flame_slope.value_or(0.0);
  rig.model_loop_gain = response * std::abs(slope);
  rig.loop_gain = rig.model_loop_gain;
  if (rig.loop_gain < spec.loop_gain_min) {
    rig.loop_gain = spec.loop_gain_min;
    slope = -rig.loop_gain / response;
    rig.slope_raised = true;
  }
  rig.flame_slope = slope;
  rig.flame = measured && !spec.flame_is_given
                  ? measured->WithSlopeAtRest(slope)
                  : Flame<double>{spec.flame_shape, slope, spec.saturation, 0.0};
  rig.parameters.model = {loop, rig.flame};
  Noise& noise = rig.parameters.noise;
  const double combustion_std = spec.combustion_noise_relative * rig.flame.saturation;
  noise.combustion_corner_hz = times.combustion_noise_corner_hz;
  noise.combustion_density =
      2.0 * combustion_std * combustion_std / (std::numbers::pi * noise.combustion_corner_hz);
  rig.heat_release_amplitude = rig.flame.saturation;
  rig.pressure_amplitude =
      rig.flame.saturation * response / (kRadPerSPerHz * experiment.frequency_hz);  // |G|
  const auto cycle = ObservedCycle(rig.parameters.model, experiment.frequency_hz);
  const SimulationOrigin origin = FindOrigin(config, experiment, rig.parameters.model, cycle);
  rig.origin = origin.text;
  rig.cycle = origin.cycle;
  if (origin.cycle) rig.parameters.past = PastOnCycle(*origin.cycle);
  if (cycle) {
    rig.pressure_amplitude = cycle->pressure_amplitude();
    rig.heat_release_amplitude = cycle->heat_release_amplitude();
    noise.pressure_sensor_std = spec.sensor_noise_relative * cycle->pressure_amplitude();
    noise.heat_release_sensor_std = spec.sensor_noise_relative * cycle->heat_release_amplitude();
  }
  return rig;
}

void AddEffects(const Config& config, const std::vector<Experiment>& experiments, double duration_s,
                std::vector<SimulatedRig>* rigs) {
  const auto count = static_cast<double>(rigs->size());
  double pressure = 0.0;
  double heat_release = 0.0;
  double rate = 0.0;
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (std::size_t i = 0; i < rigs->size(); ++i) {
    pressure += (*rigs)[i].pressure_amplitude / count;
    heat_release += (*rigs)[i].heat_release_amplitude / count;
    rate += Rate((*rigs)[i], experiments[i]) / count;
    lowest = std::min(lowest, experiments[i].phi);
    highest = std::max(highest, experiments[i].phi);
  }
  for (std::size_t i = 0; i < rigs->size(); ++i) {
    SimulatedRig& rig = (*rigs)[i];
    SimulationScale scale;
    scale.at.phi_position =
        highest > lowest ? (experiments[i].phi - lowest) / (highest - lowest) - 0.5 : 0.0;
    scale.at.cycle_frequency_hz = experiments[i].frequency_hz;
    scale.at.relative_amplitude = rig.pressure_amplitude / pressure;
    scale.at.heat_release_over_pressure = heat_release / pressure;
    scale.at.own_heat_release_over_pressure = rig.heat_release_amplitude / rig.pressure_amplitude;
    scale.at.relative_rate_amplitude = Rate(rig, experiments[i]) / rate;
    scale.pressure_amplitude = rig.pressure_amplitude;
    scale.heat_release_amplitude = rig.heat_release_amplitude;
    scale.mean_pressure_amplitude = pressure;
    scale.mean_rate_amplitude = rate;
    scale.duration_s = duration_s;
    AddNoise(config.simulation.noise, false, &rig);
    for (const SimulatedEffect& one : config.simulation.effects) {
      const std::string fault = one.effect->SimulationFault(rig.parameters, one.values);
      if (!fault.empty()) throw UserError(config.source.string(), one.line, one.key, fault);
      CHECK(one.effect->AddTo(scale, one.values, &rig.parameters)) << one.effect->id();
    }
    AddNoise(config.simulation.noise, true, &rig);
  }
}

std::string LeftItsCycle(const SimulatedRig& rig, const SimulatedRecord& record) {
  if (!rig.cycle) return "";
  const CrossSpectrum spectrum = WelchSpectrum(record.pressure, {}, record.sampling_hz);
  const auto peak = std::max_element(std::next(spectrum.pp.begin()), spectrum.pp.end());
  const double strongest_hz =
      spectrum.Frequency(static_cast<int>(std::distance(spectrum.pp.begin(), peak)));
  const double cycle_hz = rig.cycle->frequency_hz;
  if (std::abs(strongest_hz - cycle_hz) <= kSameCycle * cycle_hz) return "";
  return "its strongest line is at " + Fixed(strongest_hz, 1) + " Hz, not at the cycle's " +
         Fixed(cycle_hz, 1) + " Hz";
}

}  // namespace howl
