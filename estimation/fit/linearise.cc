#include "estimation/fit/linearise.h"

#include <ceres/crs_matrix.h>
#include <glog/logging.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace howl {
namespace {

// Projects the last of the block's columns out of the others, and removes it.
void TakeOutLast(JacobianBlock& block) {
  const Eigen::Index last = block.values.cols() - 1;
  const Eigen::VectorXd column = block.values.col(last);
  block.columns.pop_back();
  block.values.conservativeResize(Eigen::NoChange, last);
  const double size = column.squaredNorm();
  if (size > 0.0) block.values -= column * (column.transpose() * block.values) / size;
}

}  // namespace

std::vector<JacobianBlock> Linearise(const JointProblem& problem, std::vector<double> logs) {
  const std::unique_ptr<ceres::Problem> ceres_problem = problem.Build(logs.data());
  ceres::Problem::EvaluateOptions options;
  int parameters = 0;  // that are no nuisances, which come last
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (problem.parameters()[i].fixed) continue;
    options.parameter_blocks.push_back(&logs[i]);
    parameters += problem.parameters()[i].is_q_noise ? 0 : 1;
  }
  ceres::CRSMatrix sparse;
  std::vector<double> residuals;
  CHECK(ceres_problem->Evaluate(options, nullptr, &residuals, nullptr, &sparse));
  // The rows of each experiment, in their order.
  std::map<int, std::pair<std::vector<int>, std::vector<ResidualKind>>> rows_of;
  int next = 0;
  for (const ResidualBlock& residual : problem.residuals()) {
    auto& [rows, kinds] = rows_of[residual.experiment];
    for (int k = 0; k < residual.cost->num_residuals(); ++k) {
      rows.push_back(next++);
      kinds.push_back(residual.kind);
    }
  }
  CHECK_EQ(next, sparse.num_rows);
  std::vector<JacobianBlock> blocks;
  for (auto& [experiment, own] : rows_of) {
    JacobianBlock& block = blocks.emplace_back();
    const std::vector<int>& rows = own.first;
    const auto entries = [&](int row, const auto& visit) {
      const auto r = static_cast<std::size_t>(row);
      for (auto k = static_cast<std::size_t>(sparse.rows[r]);
           k < static_cast<std::size_t>(sparse.rows[r + 1]); ++k) {
        visit(sparse.cols[k], sparse.values[k]);
      }
    };
    for (const int row : rows) {
      entries(row, [&](int column, double) { block.columns.push_back(column); });
    }
    std::ranges::sort(block.columns);
    block.columns.erase(std::unique(block.columns.begin(), block.columns.end()),
                        block.columns.end());
    const auto count = static_cast<Eigen::Index>(rows.size());
    block.values = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(block.columns.size()));
    block.residuals.resize(count);
    block.kinds = std::move(own.second);
    for (Eigen::Index k = 0; k < count; ++k) {
      const int row = rows[static_cast<std::size_t>(k)];
      block.residuals(k) = residuals[static_cast<std::size_t>(row)];
      entries(row, [&](int column, double value) {
        const auto at = std::ranges::lower_bound(block.columns, column);
        block.values(k, at - block.columns.begin()) = value;
      });
    }
    while (!block.columns.empty() && block.columns.back() >= parameters) TakeOutLast(block);
  }
  return blocks;
}

}  // namespace howl
