// A quantity that should be nearly the same in all experiments: omega_prior (section 3.3, first
// qualitative condition: the geometry does not change with phi) and tau_prior (section 3.1).
//
//   residual_i = (log x_i - log x_mean) / std_relative
//
// x_mean is a free parameter of the fit, shared by the experiments: at the optimum it is their
// weighted geometric mean. Blocks: log x_i, log x_mean.
#include <ceres/autodiff_cost_function.h>

#include <vector>

#include "estimation/residuals/residual_adder.h"

namespace howl {
namespace {

struct ConstantPrior {
  template <typename T>
  bool operator()(const T* log_value, const T* log_mean, T* residual) const {
    *residual = (*log_value - *log_mean) / T(std_relative);
    return true;
  }

  double std_relative;
};

template <ParameterKind kind>
void AddConstantPrior(ResidualAdder& problem, const std::vector<int>& experiments) {
  if (problem.Model()[kind].scope == ParameterScope::kShared) return;
  if (experiments.size() < 2) return;  // one value scatters about nothing
  double log_sum = 0.0;
  for (const int i : experiments) {
    log_sum += problem.ParameterAt(problem.ParameterIndex(kind, i)).initial_log;
  }
  const int mean = problem.AddMean(kind, log_sum / static_cast<double>(experiments.size()));
  for (const int i : experiments) {
    problem.Add(i,
                new ceres::AutoDiffCostFunction<ConstantPrior, 1, 1, 1>(
                    new ConstantPrior{problem.Spec().std}),
                {problem.ParameterIndex(kind, i), mean});
  }
}

}  // namespace

ResidualDefinition OmegaPriorDefinition() {
  return {.text = "omega_hz nearly constant over the experiments",
          .equation = "section 3.3",
          .std = {"std_relative", 0.05, "relative standard deviation of omega_hz"},
          .add_across = &AddConstantPrior<ParameterKind::kOmega>};
}

ResidualDefinition TauPriorDefinition() {
  return {.text = "tau_s nearly constant over the experiments",
          .equation = "section 3.1",
          .std = {"std_relative", 0.03, "relative standard deviation of tau_s"},
          .add_across = &AddConstantPrior<ParameterKind::kTau>};
}

}  // namespace howl
