#include "io/config/simulation_spec.h"

#include <glog/logging.h>

#include <cmath>

#include "model/simulation/cycle_scale.h"

namespace howl {

SimulationTimes MakeSimulationTimes(const SimulationSpec& spec,
                                    std::span<const Experiment> experiments) {
  CHECK(!experiments.empty());
  double log_sum = 0.0;
  for (const Experiment& experiment : experiments) log_sum += std::log(experiment.frequency_hz);
  const double scale = CycleScale(std::exp(log_sum / static_cast<double>(experiments.size())));
  const SimulationTimes usual;
  return {spec.duration_s.value_or(usual.duration_s / scale),
          spec.sampling_hz.value_or(usual.sampling_hz * scale),
          spec.settle_s.value_or(usual.settle_s / scale),
          spec.combustion_noise_corner_hz.value_or(usual.combustion_noise_corner_hz * scale)};
}

}  // namespace howl
