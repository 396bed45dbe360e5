// A rig with two operating points and nothing drawn, for the tests of howl_rig's parts.
#ifndef HOWL_TESTS_RIG_TWO_POINT_RIG_H_
#define HOWL_TESTS_RIG_TWO_POINT_RIG_H_

#include <cmath>
#include <string>

#include "rig/output.h"
#include "rig/plan.h"
#include "rig/recording.h"

namespace rig {

inline Spec TwoPoints() {
  Spec spec;
  spec.experiments = {{"exp1", 0.56, 212.0, -8.0, 12.0}, {"exp2", 0.50, 204.0, -17.0, 15.0}};
  spec.scatter = false;
  spec.duration_s = 0.4;
  spec.settle_s = 0.3;
  return spec;
}

inline Record Simulate(const Spec& spec, std::size_t point = 0) {
  const Plan plan = MakePlan(spec);
  const Grid grid = MakeGrid(plan, spec.sampling_hz, spec.refine);
  const auto samples = static_cast<std::size_t>(std::lround(spec.duration_s * spec.sampling_hz));
  const auto settle = static_cast<std::size_t>(spec.settle_s / grid.step_s);
  const TrueSignals signals =
      March(plan, point, grid, settle, samples * grid.per_sample + 2 * LeadSteps(plan, grid), 5);
  return Digitise(plan, point, grid, signals, samples, spec.sampling_hz, 5);
}

inline Spec With(const std::string& effect, Parameters parameters) {
  Spec spec = TwoPoints();
  spec.effects.push_back({effect, 0.5, std::move(parameters)});
  return spec;
}

}  // namespace rig

#endif  // HOWL_TESTS_RIG_TWO_POINT_RIG_H_
