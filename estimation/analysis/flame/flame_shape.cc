#include "estimation/analysis/flame/flame_shape.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "estimation/analysis/flame/flame_bin_residual.h"
#include "model/loop/flame_shapes.h"

namespace howl {
namespace {

// The least number of bins: as many as the three unknowns, and as many again to test them.
constexpr std::size_t kLeastBins = 6;
// A guard rail, not a prior: at u = 1 the piecewise linear flame has left its slope, and no slope
// at rest describes it.
constexpr double kRelativeOffsetMax = 0.9;

std::optional<FlameShapeFit> FitOne(FlameShape shape, const FlameCurve& curve,
                                    double slope_at_rest) {
  FlameShapeFit fit;
  fit.shape = shape;
  const double half_swing = 0.5 * std::abs(curve.saturation_high - curve.saturation_low);
  if (!(half_swing > 0.0)) return std::nullopt;
  double log_saturation = std::log(half_swing);
  fit.mean = 0.5 * (curve.saturation_high + curve.saturation_low);
  ceres::Problem problem;
  for (const FlameCurveBin& bin : curve.bins) {
    if (!(bin.q_std > 0.0)) continue;
    problem.AddResidualBlock(
        FlameBinResidual::Create({shape, slope_at_rest, bin.x, bin.q, bin.q_std}), nullptr,
        &log_saturation, &fit.relative_offset, &fit.mean);
    ++fit.bins;
  }
  if (problem.NumResidualBlocks() < static_cast<int>(kLeastBins)) return std::nullopt;
  problem.SetParameterLowerBound(&fit.relative_offset, 0, -kRelativeOffsetMax);
  problem.SetParameterUpperBound(&fit.relative_offset, 0, kRelativeOffsetMax);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return std::nullopt;
  fit.saturation = std::exp(log_saturation);
  fit.chi_square = 2.0 * summary.final_cost;
  return fit;
}

}  // namespace

Flame<double> FlameShapeFit::WithSlopeAtRest(double slope_at_rest) const {
  const double relative_slope = VisitFlameShape(
      shape, [&]<FlameShape s>() { return NormalisedFlameSlope<s>(-relative_offset); });
  const double slope = slope_at_rest / relative_slope;
  return {shape, slope, saturation, relative_offset * saturation / slope};
}

std::optional<FlameShapeFit> FitFlameShape(const FlameCurve& curve, double slope_at_rest) {
  if (!(slope_at_rest < 0.0)) return std::nullopt;
  std::optional<FlameShapeFit> best;
  for (const FlameShape shape : kFlameShapes) {
    const auto fit = FitOne(shape, curve, slope_at_rest);
    if (fit && (!best || fit->chi_square < best->chi_square)) best = fit;
  }
  return best;
}

}  // namespace howl
