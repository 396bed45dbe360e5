// The joint fit of the published table: one start, eight starts, and what one evaluation costs.
#include <benchmark/benchmark.h>
#include <ceres/crs_matrix.h>

#include "estimation/fit/joint_fit.h"
#include "tests/r228.h"

namespace howl {
namespace {

void BM_SolveOneStart(benchmark::State& state) {
  const JointProblem problem(R228(), DefaultModelSpec(), DefaultResidualSet());
  for (auto _ : state) {
    benchmark::DoNotOptimize(SolveJoint(problem, {.starts = 1}, 1, 1));
  }
}
BENCHMARK(BM_SolveOneStart)->Unit(benchmark::kMicrosecond);

void BM_SolveEightStarts(benchmark::State& state) {
  const JointProblem problem(R228(), DefaultModelSpec(), DefaultResidualSet());
  for (auto _ : state) {
    benchmark::DoNotOptimize(SolveJoint(problem, {.starts = 8}, 1, 1));
  }
}
BENCHMARK(BM_SolveEightStarts)->Unit(benchmark::kMicrosecond);

void BM_EvaluateJacobian(benchmark::State& state) {
  const JointProblem problem(R228(), DefaultModelSpec(), DefaultResidualSet());
  std::vector<double> logs = problem.Start(0, 1);
  const auto ceres_problem = problem.Build(logs.data());
  std::vector<double> residuals;
  for (auto _ : state) {
    double cost = 0.0;
    ceres::CRSMatrix jacobian;
    ceres_problem->Evaluate({}, &cost, &residuals, nullptr, &jacobian);
    benchmark::DoNotOptimize(cost);
  }
  state.counters["residual_blocks"] = static_cast<double>(problem.residuals().size());
}
BENCHMARK(BM_EvaluateJacobian)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace howl
