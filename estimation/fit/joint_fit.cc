#include "estimation/fit/joint_fit.h"

#include <ceres/cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSameCost = 1e-6;
constexpr double kZeroCost = 1e-12;
constexpr double kAtBound = 1e-6;
// Nothing is learned from how near to the end of the search a parameter came.
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
  options.linear_solver_type = ceres::DENSE_QR;
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

// The last `nuisances` of them are no parameters of a model.
struct FreeParameters {
  explicit FreeParameters(const JointProblem& problem) {
    for (std::size_t i = 0; i < problem.parameters().size(); ++i) {
      if (problem.parameters()[i].fixed) continue;
      indices.push_back(static_cast<int>(i));
      nuisances += problem.parameters()[i].is_q_noise ? 1 : 0;
    }
  }
  std::vector<int> indices;
  int nuisances = 0;
};

// The Jacobian over the other columns when the last ones are free: what a nuisance can explain is
// taken out of each, so that J^T J becomes its Schur complement.
Eigen::MatrixXd WithoutNuisances(Eigen::MatrixXd jacobian, int nuisances) {
  for (; nuisances > 0; --nuisances) {
    const Eigen::Index last = jacobian.cols() - 1;
    const Eigen::VectorXd column = jacobian.col(last);
    jacobian.conservativeResize(Eigen::NoChange, last);
    const double size = column.squaredNorm();
    if (size > 0.0) jacobian -= column * (column.transpose() * jacobian) / size;
  }
  return jacobian;
}

// Weights and losses applied.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  // over the free parameters that are no nuisance
};

Linearised Linearise(const JointProblem& problem, std::vector<double> logs) {
  const std::unique_ptr<ceres::Problem> ceres_problem = problem.Build(logs.data());
  ceres::Problem::EvaluateOptions options;
  const FreeParameters free(problem);
  for (const int i : free.indices) {
    options.parameter_blocks.push_back(&logs[static_cast<std::size_t>(i)]);
  }
  ceres::CRSMatrix sparse;
  std::vector<double> residuals;
  CHECK(ceres_problem->Evaluate(options, nullptr, &residuals, nullptr, &sparse));
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    for (int k = sparse.rows[static_cast<std::size_t>(row)];
         k < sparse.rows[static_cast<std::size_t>(row) + 1]; ++k) {
      dense(row, sparse.cols[static_cast<std::size_t>(k)]) =
          sparse.values[static_cast<std::size_t>(k)];
    }
  }
  return {Eigen::Map<const Eigen::VectorXd>(residuals.data(), sparse.num_rows),
          WithoutNuisances(std::move(dense), free.nuisances)};
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

// The solver is content on a guard rail; the fit is not one.
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

// Where model and data miss each other by more than the stated standard deviations, these are too
// small for what model and data are. Each kind of residual has a factor of its own,
//
//   s_k^2 = max(1, s^2, sum r_i^2 / sum (1 - h_i)), h = diag(J C J^T), over the rows i of kind k,
//
// and s^2 is the same of all rows: two kinds that contradict each other say that either may be
// wrong, and many points of a transfer that are fitted well do not hide a few gains that are
// missed. The covariance is that of parameters whose data scatter so: C (sum s_i^2 J_i^T J_i) C.
// What is fitted as well as stated keeps C.
void WidenByMisfit(const JointProblem& problem, const Linearised& at, JointFit& fit) {
  const Eigen::MatrixXd& covariance = fit.identifiability.covariance;
  const Eigen::VectorXd leverage =
      (at.jacobian * covariance).cwiseProduct(at.jacobian).rowwise().sum();
  struct Misfit {
    double squares = 0.0, freedom = 0.0;
    double Factor() const { return squares / std::max(freedom, 1.0); }
  };
  std::map<ResidualKind, Misfit> misfits;
  Misfit all;
  std::vector<ResidualKind> kind_of_row;
  for (const ResidualBlock& block : problem.residuals()) {
    kind_of_row.insert(kind_of_row.end(), static_cast<std::size_t>(block.cost->num_residuals()),
                       block.kind);
  }
  CHECK_EQ(static_cast<Eigen::Index>(kind_of_row.size()), at.residuals.size());
  for (Eigen::Index i = 0; i < at.residuals.size(); ++i) {
    for (Misfit* misfit : {&misfits[kind_of_row[static_cast<std::size_t>(i)]], &all}) {
      misfit->squares += at.residuals(i) * at.residuals(i);
      misfit->freedom += 1.0 - leverage(i);
    }
  }
  Eigen::MatrixXd scattered = at.jacobian;
  for (Eigen::Index i = 0; i < at.residuals.size(); ++i) {
    const Misfit& kind = misfits[kind_of_row[static_cast<std::size_t>(i)]];
    scattered.row(i) *= std::sqrt(std::max({1.0, all.Factor(), kind.Factor()}));
  }
  const Eigen::MatrixXd shifts = scattered * covariance;
  const Eigen::VectorXd before = covariance.diagonal();
  fit.identifiability.covariance = shifts.transpose() * shifts;
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    if (!(before(i) > 0.0)) continue;  // nothing determines it
    fit.identifiability.log_std[static_cast<std::size_t>(i)] *=
        std::sqrt(fit.identifiability.covariance(i, i) / before(i));
  }
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

}  // namespace

namespace {

Identifiability IdentifiabilityOf(const JointProblem& problem, const Linearised& at) {
  std::vector<std::string> names;
  for (const ParameterBlock& block : problem.parameters()) {
    if (!block.fixed && !block.is_q_noise) names.push_back(block.name);
  }
  return ComputeIdentifiability(at.jacobian, names);
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
  const Linearised at = Linearise(problem, fit.logs);
  fit.identifiability = IdentifiabilityOf(problem, at);
  DescribeResiduals(problem, fit);
  WidenByMisfit(problem, at, fit);
  DescribeParameters(problem, fit);
  RefuseGuardRails(fit);
  return fit;
}

}  // namespace howl
