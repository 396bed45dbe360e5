// A quantity that should be nearly the same in all experiments: omega_prior (section 3.3, first
// qualitative condition: the geometry does not change with phi) and tau_prior (section 3.1).
//
//   residual_i = (log x_i - log x_mean) / std_relative
//
// x_mean is a free parameter of the fit, shared by the experiments: at the optimum it is their
// weighted geometric mean. Blocks: log x_i, log x_mean.
#ifndef HOWL_ESTIMATION_RESIDUALS_CONSTANT_PRIOR_H_
#define HOWL_ESTIMATION_RESIDUALS_CONSTANT_PRIOR_H_

#include <ceres/autodiff_cost_function.h>

namespace howl {

struct ConstantPrior {
  template <typename T>
  bool operator()(const T* log_value, const T* log_mean, T* residual) const {
    *residual = (*log_value - *log_mean) / T(std_relative);
    return true;
  }

  static ceres::CostFunction* Create(double std_relative) {
    return new ceres::AutoDiffCostFunction<ConstantPrior, 1, 1, 1>(new ConstantPrior{std_relative});
  }

  double std_relative;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_CONSTANT_PRIOR_H_
