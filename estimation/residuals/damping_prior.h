// A persistent acoustic resonance is lightly damped (section 3.3), as a log-normal prior:
//
//   residual = log(xi / xi_typical) / std_relative
//
// Block: log xi. xi_typical: a damping ratio that is taken as small; std_relative: how far, as a
// share of itself, xi may be from it. A prior centred on zero damping would have no optimum: as xi
// vanishes, N vanishes with it and nothing in the data opposes.
#ifndef HOWL_ESTIMATION_RESIDUALS_DAMPING_PRIOR_H_
#define HOWL_ESTIMATION_RESIDUALS_DAMPING_PRIOR_H_

#include <ceres/autodiff_cost_function.h>

#include <cmath>

namespace howl {

struct DampingPrior {
  template <typename T>
  bool operator()(const T* log_xi, T* residual) const {
    *residual = (*log_xi - T(std::log(xi_typical))) / T(std_relative);
    return true;
  }

  static ceres::CostFunction* Create(double xi_typical, double std_relative) {
    return new ceres::AutoDiffCostFunction<DampingPrior, 1, 1>(
        new DampingPrior{xi_typical, std_relative});
  }

  double xi_typical;
  double std_relative;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_DAMPING_PRIOR_H_
