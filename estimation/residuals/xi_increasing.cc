// Damping does not fall as the operating parameter grows (section 3.3, second qualitative
// condition). For neighbours in phi, one-sided:
//
//   residual = max(0, xi(lower phi) - xi(higher phi)) / std
//
// Blocks: log xi at the lower phi, log xi at the higher phi. std: of a damping ratio, absolute.
#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/residuals/residual_adder.h"

namespace howl {
namespace {

struct XiIncreasing {
  template <typename T>
  bool operator()(const T* log_xi_lower_phi, const T* log_xi_higher_phi, T* residual) const {
    using std::exp;
    const T fall = exp(*log_xi_lower_phi) - exp(*log_xi_higher_phi);
    *residual = fall > T(0.0) ? fall / T(std) : T(0.0);
    return true;
  }

  double std;
};

void AddXiIncreasing(ResidualAdder& problem, const std::vector<int>& experiments) {
  if (problem.Model()[ParameterKind::kXi].scope == ParameterScope::kShared) return;
  std::vector<int> order = experiments;
  std::ranges::stable_sort(order, {}, [&](int i) { return problem.ExperimentAt(i).phi; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    // The block belongs to the less reliable of the two.
    const int lower = order[k - 1];
    const int higher = order[k];
    const int owner = problem.ExperimentAt(lower).reliable ? higher : lower;
    problem.Add(owner,
                new ceres::AutoDiffCostFunction<XiIncreasing, 1, 1, 1>(
                    new XiIncreasing{problem.Spec().std}),
                {problem.ParameterIndex(ParameterKind::kXi, lower),
                 problem.ParameterIndex(ParameterKind::kXi, higher)});
  }
}

}  // namespace

ResidualDefinition XiIncreasingDefinition() {
  return {.text = "xi does not fall as phi grows (one-sided)",
          .equation = "section 3.3",
          .std = {"std", 0.02, "standard deviation of xi"},
          .add_across = &AddXiIncreasing};
}

}  // namespace howl
