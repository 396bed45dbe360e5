// The flame's shape as an experiment's record shows it.
#ifndef HOWL_APP_INPUT_MEASURED_FLAME_H_
#define HOWL_APP_INPUT_MEASURED_FLAME_H_

#include <optional>

#include "app/input/problem_input.h"
#include "estimation/analysis/flame/flame_shape.h"

namespace howl {

// No value for an experiment that no record gave, or whose record has no flame curve.
std::optional<FlameShapeFit> MeasuredFlame(const ProblemInput& input, const Experiment& experiment);

}  // namespace howl

#endif  // HOWL_APP_INPUT_MEASURED_FLAME_H_
