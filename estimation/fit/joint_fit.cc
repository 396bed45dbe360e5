#include "estimation/fit/joint_fit.h"

#include <ceres/cost_function.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "estimation/fit/linearise.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSameCost = 1e-6;
constexpr double kZeroCost = 1e-12;
constexpr double kAtBound = 1e-6;
// Parameters up to which the dense solver is the faster one (bench/scaling_study).
constexpr std::size_t kMostDense = 40;
// A parameter this near to the end of the search counts as at the end.
constexpr double kAtGuardRail = 1e-3;

struct StartResult {
  std::vector<double> logs;
  double cost = 0.0;
  bool converged = false;
  int iterations = 0;
  std::string termination;
};

StartResult SolveStart(const JointProblem& problem, const SolverSpec& solver,
                       const std::vector<double>& start) {
  StartResult result;
  result.logs = start;
  const std::unique_ptr<ceres::Problem> ceres_problem = problem.Build(result.logs.data());
  ceres::Solver::Options options;
  // A step costs the cube of the number of parameters with the dense solver, which keeps J as it
  // is; with the sparse one about their number, as each residual knows one experiment.
  options.linear_solver_type =
      start.size() > kMostDense ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  options.max_num_iterations = solver.max_iterations;
  options.function_tolerance = 1e-18;
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, ceres_problem.get(), &summary);
  result.cost = summary.final_cost;
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.iterations = static_cast<int>(summary.iterations.size());
  result.termination = std::string(ceres::TerminationTypeToString(summary.termination_type)) +
                       ": " + summary.message;
  return result;
}

// A bound that no one set (FitParameter).
bool IsGuardRail(const JointProblem& problem, ParameterKind kind, bool upper) {
  static const ModelSpec defaults = DefaultModelSpec();
  const bool second_mode = kind == ParameterKind::kM || kind == ParameterKind::kMOverN;
  if (second_mode && !upper) return false;
  return upper ? problem.model()[kind].max == defaults[kind].max
               : problem.model()[kind].min == defaults[kind].min;
}

void DescribeParameters(const JointProblem& problem, JointFit& fit) {
  std::size_t column = 0;
  for (std::size_t i = 0; i < problem.parameters().size(); ++i) {
    const ParameterBlock& block = problem.parameters()[i];
    if (block.is_q_noise) continue;
    FitParameter parameter;
    parameter.name = block.name;
    parameter.value = std::exp(fit.logs[i]);
    parameter.fixed = block.fixed;
    if (!block.fixed) {
      parameter.std_relative = fit.identifiability.log_std[column++];
      const double below = block.max_log - fit.logs[i];
      const double above = fit.logs[i] - block.min_log;
      const bool upper = below < above;
      const double distance = std::min(below, above);
      const bool guard_rail = IsGuardRail(problem, block.kind, upper);
      parameter.at_bound = distance < (guard_rail ? kAtGuardRail : kAtBound);
      parameter.at_guard_rail = parameter.at_bound && guard_rail;
      parameter.bound = parameter.at_bound ? std::exp(upper ? block.max_log : block.min_log) : 0.0;
      fit.free_names.push_back(block.name);
    }
    fit.parameters.push_back(std::move(parameter));
  }
}

// The solver may converge on a guard rail, where the result is no fit.
void RefuseGuardRails(JointFit& fit) {
  std::string names;
  for (const FitParameter& parameter : fit.parameters) {
    if (parameter.at_guard_rail) names += (names.empty() ? "" : ", ") + parameter.name;
  }
  if (names.empty()) return;
  fit.converged = false;
  fit.termination = "GUARD_RAIL: the data drive " + names + " out of every model";
}

void DescribeResiduals(const JointProblem& problem, JointFit& fit) {
  for (const ResidualBlock& block : problem.residuals()) {
    std::vector<const double*> parameters;
    for (const int index : block.parameters) {
      parameters.push_back(&fit.logs[static_cast<std::size_t>(index)]);
    }
    FitResidual residual{block.label, {}, block.weight};
    residual.values.resize(static_cast<std::size_t>(block.cost->num_residuals()));
    CHECK(block.cost->Evaluate(parameters.data(), residual.values.data(), nullptr)) << block.label;
    fit.residuals.push_back(std::move(residual));
  }
}

// Where model and data differ by more than the stated standard deviations, these are too small.
// Each kind of residual has a factor of its own,
//
//   s_k^2 = max(1, s^2, sum r_i^2 / sum (1 - h_i)), h = diag(J C J^T), over the rows i of kind k,
//
// and s^2 is the same over all rows. Where two kinds contradict each other, either may be wrong;
// and many points of a transfer that are fitted well do not hide a few gains that are missed. The
// covariance is that of parameters whose data have this scatter: C (sum s_i^2 J_i^T J_i) C. Where
// all data are fitted as well as stated, it is C.
void WidenByMisfit(std::vector<JacobianBlock> jacobian, JointFit& fit) {
  struct Misfit {
    double squares = 0.0, freedom = 0.0;
    double Factor() const { return squares / std::max(freedom, 1.0); }
  };
  std::map<ResidualKind, Misfit> misfits;
  Misfit all;
  for (const JacobianBlock& block : jacobian) {
    const Eigen::MatrixXd covariance = fit.identifiability.covariance.Of(block.columns);
    const Eigen::VectorXd leverage =
        (block.values * covariance).cwiseProduct(block.values).rowwise().sum();
    for (Eigen::Index i = 0; i < block.residuals.size(); ++i) {
      for (Misfit* misfit : {&misfits[block.kinds[static_cast<std::size_t>(i)]], &all}) {
        misfit->squares += block.residuals(i) * block.residuals(i);
        misfit->freedom += 1.0 - leverage(i);
      }
    }
  }
  for (JacobianBlock& block : jacobian) {
    for (Eigen::Index i = 0; i < block.residuals.size(); ++i) {
      const Misfit& kind = misfits[block.kinds[static_cast<std::size_t>(i)]];
      block.values.row(i) *= std::sqrt(std::max({1.0, all.Factor(), kind.Factor()}));
    }
  }
  LogCovariance& covariance = fit.identifiability.covariance;
  LogCovariance scattered = covariance.Scattered(jacobian);
  for (int i = 0; i < covariance.size(); ++i) {
    const double before = covariance(i, i);
    if (!(before > 0.0)) continue;  // nothing determines it
    fit.identifiability.log_std[static_cast<std::size_t>(i)] *= std::sqrt(scattered(i, i) / before);
  }
  covariance = std::move(scattered);
}

// The first start that reaches the lowest cost; one that converged beats one that did not. None
// where no cost is finite: Ceres gives -1 where it could not evaluate its problem at all.
std::vector<StartResult>::const_iterator BestStart(const std::vector<StartResult>& starts) {
  const bool any_converged =
      std::ranges::any_of(starts, [](const StartResult& start) { return start.converged; });
  const auto counts = [&](const StartResult& start) {
    return std::isfinite(start.cost) && start.cost >= 0.0 && (start.converged || !any_converged);
  };
  double lowest = std::numeric_limits<double>::infinity();
  for (const StartResult& start : starts) {
    if (counts(start)) lowest = std::min(lowest, start.cost);
  }
  return std::ranges::find_if(starts, [&](const StartResult& start) {
    return counts(start) && start.cost <= lowest * (1.0 + kSameCost) + kZeroCost;
  });
}

// Every number of it that is fitted is NaN; the models are those of the first start.
JointFit FailedFit(const JointProblem& problem, const std::vector<StartResult>& starts) {
  JointFit fit;
  fit.termination = problem.residuals().empty()
                        ? "FAILURE: no residual acts on these experiments"
                        : "FAILURE: the residuals are not finite at any start";
  fit.cost = kNan;
  fit.starts = static_cast<int>(starts.size());
  fit.logs = starts.front().logs;
  fit.models = problem.Models(fit.logs);
  for (std::size_t i = 0; i < problem.parameters().size(); ++i) {
    const ParameterBlock& block = problem.parameters()[i];
    FitParameter parameter;
    parameter.name = block.name;
    parameter.value = std::exp(fit.logs[i]);
    parameter.std_relative = kNan;
    parameter.fixed = block.fixed;
    if (!block.fixed) fit.free_names.push_back(block.name);
    fit.parameters.push_back(std::move(parameter));
  }
  for (const ResidualBlock& block : problem.residuals()) {
    const auto size = static_cast<std::size_t>(block.cost->num_residuals());
    fit.residuals.push_back({block.label, std::vector<double>(size, kNan), block.weight});
  }
  return fit;
}

Identifiability IdentifiabilityOf(const JointProblem& problem,
                                  const std::vector<JacobianBlock>& jacobian) {
  std::vector<std::string> names;
  std::vector<bool> shared;
  for (const ParameterBlock& block : problem.parameters()) {
    if (block.fixed || block.is_q_noise) continue;
    names.push_back(block.name);
    shared.push_back(block.experiment == kShared);
  }
  return ComputeIdentifiability(jacobian, names, shared);
}

}  // namespace

Identifiability IdentifiabilityAt(const JointProblem& problem, const std::vector<double>& logs) {
  return IdentifiabilityOf(problem, Linearise(problem, logs));
}

double JointCost(const JointProblem& problem, std::vector<double> logs) {
  const std::unique_ptr<ceres::Problem> ceres_problem = problem.Build(logs.data());
  double cost = 0.0;
  if (!ceres_problem->Evaluate({}, &cost, nullptr, nullptr, nullptr)) return kNan;
  return cost;
}

JointFit SolveJoint(const JointProblem& problem, const SolverSpec& solver, std::uint64_t seed,
                    int threads) {
  CHECK_GE(solver.starts, 1);
  std::vector<std::vector<double>> starts;
  for (int number = 0; number < solver.starts; ++number) {
    starts.push_back(problem.Start(number, seed));
  }
  return SolveJointFrom(problem, solver, starts, threads);
}

JointFit SolveJointFrom(const JointProblem& problem, const SolverSpec& solver,
                        const std::vector<std::vector<double>>& from, int threads) {
  CHECK(!from.empty());
  std::vector<StartResult> starts(from.size());
  RunUnits(starts.size(), threads, [&](std::size_t number) {
    starts[number] = SolveStart(problem, solver, from[number]);
    VLOG(2) << "start " << number << ": cost " << starts[number].cost << " in "
            << starts[number].iterations << " iterations; " << starts[number].termination;
  });
  const auto best = BestStart(starts);
  if (problem.residuals().empty() || best == starts.end()) return FailedFit(problem, starts);
  JointFit fit;
  fit.converged = best->converged;
  fit.termination = best->termination;
  fit.cost = best->cost;
  fit.iterations = best->iterations;
  fit.starts = static_cast<int>(from.size());
  for (const StartResult& start : starts) {
    fit.starts_converged += start.converged ? 1 : 0;
    const bool same = std::abs(start.cost - best->cost) <= kSameCost * best->cost + kZeroCost;
    fit.starts_at_best += start.converged && same ? 1 : 0;
  }
  VLOG(1) << "joint fit: " << problem.residuals().size() << " residual blocks, "
          << problem.parameters().size() << " parameters; cost " << fit.cost << ", reached by "
          << fit.starts_at_best << " of " << fit.starts << " starts; " << fit.termination;
  fit.logs = best->logs;
  fit.models = problem.Models(fit.logs);
  std::vector<JacobianBlock> jacobian = Linearise(problem, fit.logs);
  fit.identifiability = IdentifiabilityOf(problem, jacobian);
  DescribeResiduals(problem, fit);
  WidenByMisfit(std::move(jacobian), fit);
  DescribeParameters(problem, fit);
  RefuseGuardRails(fit);
  return fit;
}

}  // namespace howl
