// The saturating flame of model/loop/flame.h that is nearest to a measured curve (flame_curve.h):
// of all shapes the one with the least weighted squares over the curve's bins, with saturation,
// offset and mean fitted and the slope at rest held at what is given,
//
//   min over shape, Q, u, mean of  sum_bins ((mean + Q sigma(k v / Q - u) - q) / q_std)^2,
//   k = Phi'(0) / sigma'(-u)                                  (analysis/flame_bin_residual.h)
#ifndef HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_SHAPE_H_
#define HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_SHAPE_H_

#include <optional>

#include "estimation/analysis/flame/flame_curve.h"
#include "model/loop/flame.h"

namespace howl {

struct FlameShapeFit {
  FlameShape shape = FlameShape::kTanh;
  double saturation = 1.0;       // Q, units of q
  double relative_offset = 0.0;  // u = k v0 / Q
  double mean = 0.0;             // of q, units of q
  double chi_square = 0.0;
  int bins = 0;

  // The same shape, saturation and relative offset with another slope at rest, Phi'(0) < 0.
  Flame<double> WithSlopeAtRest(double slope_at_rest) const;
};

// No value where the curve has too few bins or the slope is not negative. slope_at_rest: Phi'(0) in
// (units of q) / (units of p / s).
std::optional<FlameShapeFit> FitFlameShape(const FlameCurve& curve, double slope_at_rest);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_SHAPE_H_
