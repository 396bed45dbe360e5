// Solves a JointProblem from several starts and reports the best solution with its errors.
#ifndef HOWL_ESTIMATION_FIT_JOINT_FIT_H_
#define HOWL_ESTIMATION_FIT_JOINT_FIT_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "estimation/fit/identifiability.h"
#include "estimation/fit/joint_problem.h"
#include "estimation/fit/solver_spec.h"

namespace howl {

struct FitParameter {
  std::string name;
  double value = 0.0;  // natural units
  // Standard deviation of the logarithm, widened where the fit misses a kind of residual by more
  // than the stated standard deviations: by how much, in the covariance C (sum s_i^2 J_i^T J_i) C
  // with s_i^2 the kind's, or all residuals', chi-square per degree of freedom where that exceeds
  // one. Infinite: not determined.
  double std_relative = 0.0;
  bool at_bound = false;
  // True where the parameter is at a bound that no one set, a default that only keeps the search in
  // the range of numbers. A fit that ends there is no fit, because the data drive the parameter out
  // of every model. A second mode of vanishing size is no such end: it is the model with one mode.
  bool at_guard_rail = false;
  double bound = 0.0;  // the one that it stands at, natural units
  bool fixed = false;
};

struct FitResidual {
  std::string label;
  std::vector<double> values;  // in standard deviations, before weight and loss
  double weight = 1.0;
};

struct JointFit {
  bool converged = false;   // the solver did, and no parameter stands on a guard rail
  std::string termination;  // Ceres' word, then its message; or GUARD_RAIL and who stands there
  double cost = 0.0;        // NaN where it failed: no residual, or none finite at any start
  int iterations = 0;
  int starts = 0;
  int starts_converged = 0;
  int starts_at_best = 0;  // that reached the best cost to 1e-6
  std::vector<double> logs;
  std::vector<LoopModel> models;         // one an experiment
  std::vector<FitParameter> parameters;  // of the models: without the unknowns of the transfers
  std::vector<FitResidual> residuals;
  // For the parameters that are not fixed, in their order; the covariance is widened as above.
  std::vector<std::string> free_names;
  Identifiability identifiability;
};

// Start number 0 is always tried; ties in cost go to the lowest number, so that the answer does not
// depend on `threads`.
JointFit SolveJoint(const JointProblem& problem, const SolverSpec& solver, std::uint64_t seed,
                    int threads);

// The same from these starts, each of problem.parameters().size() logarithms, instead of the
// problem's own.
JointFit SolveJointFrom(const JointProblem& problem, const SolverSpec& solver,
                        const std::vector<std::vector<double>>& starts, int threads);

// The cost at `logs` with weights and losses applied; NaN where a residual is not finite.
double JointCost(const JointProblem& problem, std::vector<double> logs);

// J and identifiability at `logs` (weights and losses applied).
Identifiability IdentifiabilityAt(const JointProblem& problem, const std::vector<double>& logs);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_JOINT_FIT_H_
