#include "app/input/measured_flame.h"

namespace howl {

std::optional<FlameShapeFit> MeasuredFlame(const ProblemInput& input,
                                           const Experiment& experiment) {
  if (!input.analysis || !experiment.flame_slope) return std::nullopt;
  for (const Analysis& analysis : input.analysis->analyses) {
    if (analysis.name != experiment.name || !analysis.flame_curve) continue;
    return FitFlameShape(*analysis.flame_curve, *experiment.flame_slope);
  }
  return std::nullopt;
}

}  // namespace howl
