// Two modes have two branches on which the data may be fitted: the paper's, on which the first mode
// carries the limit cycle and the second hardly matters there, (5b), and another on which the
// second mode adds as much as the first, with omega well below the cycle's frequency. On the
// published experiments both fit (5a). Which one a fit is on is told by
//
//   share = |M U_r(j 2 pi f)| / |N U_1(j 2 pi f)|, largest over the experiments
//
// and the cost of the other branch is found by a second fit from starts on it.
#ifndef HOWL_ESTIMATION_FIT_MODE_BRANCH_H_
#define HOWL_ESTIMATION_FIT_MODE_BRANCH_H_

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "estimation/fit/joint_fit.h"

namespace howl {

struct ModeBranch {
  double cost = 0.0;  // without second_mode_minor, so that both branches are measured alike
  double share = 0.0;
  std::vector<LoopModel> models;  // one an experiment

  // A fit that a residual holds ends a little above the share that is asked for, hence the margin.
  bool IsPapers(double share_max) const { return share <= 1.5 * share_max; }
};

// The largest share over the experiments.
double LargestSecondModeShare(std::span<const Experiment> experiments,
                              std::span<const LoopModel> models);

struct BranchComparison {
  double share_max = 0.0;  // of second_mode_minor: what sets the branches apart
  ModeBranch fit;
  std::optional<ModeBranch> other;  // the best that was found on the branch that `fit` is not on

  // True where the data alone prefer the other branch: `fit` is held by second_mode_minor, or is a
  // worse optimum.
  bool DataPreferOther() const { return other && other->cost < fit.cost * (1.0 - 1e-6); }
};

// For two modes only. residuals: those that `problem` was made with; fit: its solution.
BranchComparison CompareBranches(const JointProblem& problem, const ResidualSet& residuals,
                                 const JointFit& fit, const SolverSpec& solver, std::uint64_t seed,
                                 int threads);

// A start near `start` but on the branch where the second mode carries the cycle: omega lies at
// f r^-depth, 0 < depth < 1, and N and M follow from gain and phase of each experiment.
std::vector<double> OtherBranchStart(const JointProblem& problem, std::vector<double> start,
                                     double depth);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_MODE_BRANCH_H_
