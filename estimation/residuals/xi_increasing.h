// Damping does not fall as the operating parameter grows (section 3.3, second qualitative
// condition). For neighbours in phi, one-sided:
//
//   residual = max(0, xi(lower phi) - xi(higher phi)) / std
//
// Blocks: log xi at the lower phi, log xi at the higher phi. std: of a damping ratio, absolute.
#ifndef HOWL_ESTIMATION_RESIDUALS_XI_INCREASING_H_
#define HOWL_ESTIMATION_RESIDUALS_XI_INCREASING_H_

#include <ceres/autodiff_cost_function.h>

#include <cmath>

namespace howl {

struct XiIncreasing {
  template <typename T>
  bool operator()(const T* log_xi_lower_phi, const T* log_xi_higher_phi, T* residual) const {
    using std::exp;
    const T fall = exp(*log_xi_lower_phi) - exp(*log_xi_higher_phi);
    *residual = fall > T(0.0) ? fall / T(std) : T(0.0);
    return true;
  }

  static ceres::CostFunction* Create(double std) {
    return new ceres::AutoDiffCostFunction<XiIncreasing, 1, 1, 1>(new XiIncreasing{std});
  }

  double std;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_XI_INCREASING_H_
