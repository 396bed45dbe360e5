// One bin of the measured flame curve against a saturating shape whose slope at rest is held:
//
//   residual = (mean + Q sigma(k v / Q - u) - q) / q_std,     k = Phi'(0) / sigma'(-u)
//
// sigma: NormalisedFlame of the shape (model/loop/flame.h); u = k v0 / Q, the offset relative to
// the knee, so that Phi'(0) is the same whatever u is. Blocks: log Q, u, mean (units of q).
#ifndef HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_BIN_RESIDUAL_H_
#define HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_BIN_RESIDUAL_H_

#include <ceres/autodiff_cost_function.h>

#include <cmath>

#include "model/loop/flame.h"

namespace howl {

struct FlameBinResidual {
  template <typename T>
  bool operator()(const T* log_saturation, const T* relative_offset, const T* mean,
                  T* residual) const {
    using std::exp;
    const T saturation = exp(*log_saturation);
    const T response = VisitFlameShape(shape, [&]<FlameShape s>() {
      const T slope = T(slope_at_rest) / NormalisedFlameSlope<s>(T(-*relative_offset));
      return saturation * NormalisedFlame<s>(T(slope * v / saturation - *relative_offset));
    });
    *residual = (*mean + response - q) / q_std;
    return true;
  }

  static ceres::CostFunction* Create(const FlameBinResidual& bin) {
    return new ceres::AutoDiffCostFunction<FlameBinResidual, 1, 1, 1, 1>(new FlameBinResidual(bin));
  }

  FlameShape shape = FlameShape::kTanh;
  double slope_at_rest = 0.0;  // Phi'(0), (units of q) / (units of p / s)
  double v = 0.0;              // p'(t - tau), (units of p) / s
  double q = 0.0;
  double q_std = 1.0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_BIN_RESIDUAL_H_
