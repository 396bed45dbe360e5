// The delayed loop in time: two modes, tanh flame; one rig alone, and eight in vector lanes.
#include <memory>

#include "bench/limits/measured.h"
#include "model/simulation/simulate.h"

namespace howl::limits {
namespace {

std::function<double()> Prepare(int members, double noise) {
  auto cases = std::make_shared<std::vector<SimulationCase>>();
  for (int i = 0; i < members; ++i) {
    SimulationCase one;
    one.rig.model = {{{215.0 - i, 0.2, 6609.0, 2743.0, 3.0}, 0.00346 + 1e-5 * i},
                     {FlameShape::kTanh, -0.703e-4, 0.5, 0.0}};
    one.rig.noise.combustion_density = noise;
    one.rig.noise.combustion_corner_hz = 1000.0;
    one.rig.past = {{0.1, 216.0, 0.0, 0.0}};
    one.seed = static_cast<std::uint64_t>(i);
    cases->push_back(std::move(one));
  }
  SimulationOptions options;
  // Long against its record: the anti-alias filter is no part of a step.
  options.duration_s = 0.01;
  options.settle_s = members == 1 ? 10.0 : 4.0;
  options.internal_hz = 20000.0;
  options.threads = 1;
  return [cases, options] {
    SimulateBatch(*cases, options);
    return options.settle_s * options.internal_hz * static_cast<double>(cases->size());
  };
}

}  // namespace

std::vector<Measured> SimulateLoads() {
  return {{"simulate, one rig", "step", [] { return Prepare(1, 0.0); }},
          {"simulate, eight rigs", "step", [] { return Prepare(8, 0.0); }},
          {"simulate, eight rigs with noise", "step", [] { return Prepare(8, 1e-8); }}};
}

}  // namespace howl::limits
