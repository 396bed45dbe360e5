#include "estimation/fit/substructure.h"

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

struct Decomposition {
  explicit Decomposition(const Eigen::MatrixXd& matrix, double least)
      : svd(DecomposeSingular(matrix)) {
    while (rank < svd.values.size() && svd.values(rank) > least) ++rank;
  }
  auto U() const { return svd.u.leftCols(rank); }
  auto V() const { return svd.v.leftCols(rank); }
  Eigen::MatrixXd Free() const { return svd.v.rightCols(svd.v.cols() - rank); }
  Eigen::VectorXd Inverse() const { return svd.values.head(rank).cwiseInverse(); }
  // V S^-2 V^T
  Eigen::MatrixXd Covariance() const {
    const Eigen::MatrixXd scaled = V() * Inverse().asDiagonal();
    return scaled * scaled.transpose();
  }

  SingularValues svd;
  Eigen::Index rank = 0;
};

// (I - N N^T) (D + Y K Y^T) (I - N N^T) = D + F M F^T with F = (Y - N N^T Y, N, D N).
void Project(const Eigen::MatrixXd& N, LogCovariance::Set& set) {
  const Eigen::Index b = set.factor.cols(), k = N.cols();
  Eigen::MatrixXd D_N(N.rows(), k);
  Eigen::Index row = 0;
  for (const Eigen::MatrixXd& diagonal : set.diagonal) {
    D_N.middleRows(row, diagonal.rows()) = diagonal * N.middleRows(row, diagonal.rows());
    row += diagonal.rows();
  }
  Eigen::MatrixXd factor(N.rows(), b + 2 * k);
  factor << set.factor - N * (N.transpose() * set.factor), N, D_N;
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(b + 2 * k, b + 2 * k);
  middle.topLeftCorner(b, b) = set.middle;
  middle.block(b, b, k, k) = N.transpose() * D_N;
  middle.block(b, b + k, k, k) = -Eigen::MatrixXd::Identity(k, k);
  middle.block(b + k, b, k, k) = -Eigen::MatrixXd::Identity(k, k);
  set.factor = std::move(factor);
  set.middle = std::move(middle);
}

}  // namespace

Substructure AnalyseSubstructure(const std::vector<JacobianBlock>& jacobian,
                                 const ConnectedSet& set, const std::vector<bool>& shared,
                                 double least) {
  Substructure result;
  std::vector<int> border;
  std::vector<bool> is_inner(shared.size(), false);
  for (const int column : set.columns) {
    const bool is_shared = shared[static_cast<std::size_t>(column)];
    if (is_shared) border.push_back(column);
    is_inner[static_cast<std::size_t>(column)] = !is_shared;
  }
  const auto b = static_cast<Eigen::Index>(border.size());
  std::vector<ConnectedSet> blocks =
      ConnectedColumns(jacobian, static_cast<int>(shared.size()),
                       [&](int column) { return is_inner[static_cast<std::size_t>(column)]; });
  // Rows of what is shared alone.
  std::vector<std::pair<int, int>> rest = set.rows;
  std::vector<std::pair<int, int>> taken;
  for (const ConnectedSet& block : blocks) {
    taken.insert(taken.end(), block.rows.begin(), block.rows.end());
  }
  std::ranges::sort(rest);
  std::ranges::sort(taken);
  std::vector<std::pair<int, int>> alone;
  std::ranges::set_difference(rest, taken, std::back_inserter(alone));

  LogCovariance::Set& covariance = result.covariance;
  const Eigen::MatrixXd alone_rows = DenseRows(jacobian, alone, border);
  std::vector<Eigen::MatrixXd> left;  // (I - U U^T) B of each block
  left.push_back(alone_rows);
  Eigen::Index left_rows = alone_rows.rows();
  covariance.factor = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(set.columns.size()), b);
  Eigen::Index row = 0;
  for (const ConnectedSet& block : blocks) {
    const Decomposition local(DenseRows(jacobian, block.rows, block.columns), least);
    const Eigen::MatrixXd B = DenseRows(jacobian, block.rows, border);
    const Eigen::MatrixXd along = local.U().transpose() * B;
    left.emplace_back(B - local.U() * along);
    left_rows += B.rows();
    const auto width = static_cast<Eigen::Index>(block.columns.size());
    covariance.factor.middleRows(row, width) = -(local.V() * local.Inverse().asDiagonal() * along);
    row += width;
    covariance.diagonal.push_back(local.Covariance());
    covariance.blocks.push_back(block.columns);
    result.rank += static_cast<int>(local.rank);
    if (local.rank < width) result.free.push_back({block.columns, local.Free().transpose()});
  }
  Eigen::MatrixXd stacked(left_rows, b);
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& part : left) {
    stacked.middleRows(at, part.rows()) = part;
    at += part.rows();
  }
  const Decomposition between(stacked, least);
  result.rank += static_cast<int>(between.rank);
  covariance.factor.bottomRows(b) = Eigen::MatrixXd::Identity(b, b);
  covariance.middle = between.Covariance();
  covariance.blocks.push_back(border);
  covariance.diagonal.push_back(Eigen::MatrixXd::Zero(b, b));
  if (between.rank == b) return result;
  const Eigen::MatrixXd free = covariance.factor * between.Free();
  const Eigen::MatrixXd N = OrthonormalColumns(free);
  Project(N, covariance);
  FreeSpace all;
  for (const std::vector<int>& columns : covariance.blocks) {
    all.columns.insert(all.columns.end(), columns.begin(), columns.end());
  }
  all.rows = N.transpose();
  result.free.push_back(std::move(all));
  return result;
}

}  // namespace howl
