// A persistent acoustic resonance is lightly damped (section 3.3), as a log-normal prior:
//
//   residual = log(xi / xi_typical) / std_relative
//
// Block: log xi. xi_typical: a damping ratio that is taken as small; std_relative: how far, as a
// share of itself, xi may be from it. A prior centred on zero damping would have no optimum: as xi
// vanishes, N vanishes with it and nothing in the data opposes.
#include <ceres/autodiff_cost_function.h>

#include <cmath>

#include "estimation/residuals/residual_adder.h"

namespace howl {
namespace {

struct DampingPrior {
  template <typename T>
  bool operator()(const T* log_xi, T* residual) const {
    *residual = (*log_xi - T(std::log(xi_typical))) / T(std_relative);
    return true;
  }

  double xi_typical;
  double std_relative;
};

void AddDampingPrior(ResidualAdder& problem, int i) {
  problem.Add(i,
              new ceres::AutoDiffCostFunction<DampingPrior, 1, 1>(
                  new DampingPrior{problem.Spec().center, problem.Spec().std}),
              {problem.ParameterIndex(ParameterKind::kXi, i)});
}

}  // namespace

ResidualDefinition DampingPriorDefinition() {
  return {.text = "xi near a small value",
          .equation = "section 3.3",
          .std = {"std_relative", 1.0, "relative standard deviation of xi about xi_typical"},
          .center = {"xi_typical", 0.1, "damping ratio that counts as small"},
          .add_to = &AddDampingPrior};
}

}  // namespace howl
