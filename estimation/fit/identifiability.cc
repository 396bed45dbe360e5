#include "estimation/fit/identifiability.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "estimation/fit/connected_columns.h"
#include "estimation/fit/substructure.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

// Singular values below this share of the largest are zero but for rounding.
constexpr double kRankTolerance = 1e-9;
// A parameter with a smaller component than this takes no part in a direction that is free.
constexpr double kNegligible = 1e-3;
// Text names the components above this share of the largest, and counts the others.
constexpr double kWorthNaming = 0.003;
constexpr double kWorthNamingWhenMany = 0.1;
constexpr std::size_t kMany = 6;

// Another basis of the same space, each vector of which involves few parameters: reduced row
// echelon form with the largest pivot, then unit length.
void MakeSparse(Eigen::MatrixXd& basis_rows) {
  for (Eigen::Index k = 0; k < basis_rows.rows(); ++k) {
    Eigen::Index pivot_row = 0;
    Eigen::Index pivot_column = 0;
    basis_rows.bottomRows(basis_rows.rows() - k).cwiseAbs().maxCoeff(&pivot_row, &pivot_column);
    basis_rows.row(k).swap(basis_rows.row(k + pivot_row));
    basis_rows.row(k) /= basis_rows(k, pivot_column);
    for (Eigen::Index other = 0; other < basis_rows.rows(); ++other) {
      if (other == k) continue;
      const double factor = basis_rows(other, pivot_column);
      basis_rows.row(other) -= factor * basis_rows.row(k);
    }
  }
  for (Eigen::Index k = 0; k < basis_rows.rows(); ++k) basis_rows.row(k).normalize();
}

// `direction` in the parameters `columns`.
std::string Describe(const Eigen::VectorXd& direction, const std::vector<int>& columns,
                     const std::vector<std::string>& names, double log_std) {
  const auto name_of = [&](int i) -> const std::string& {
    return names[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])];
  };
  const double largest = direction.cwiseAbs().maxCoeff();
  const auto larger_than = [&](double share) {
    std::vector<int> indices;
    for (int i = 0; i < direction.size(); ++i) {
      if (std::abs(direction(i)) > share * largest) indices.push_back(i);
    }
    return indices;
  };
  const std::size_t all = larger_than(kWorthNaming).size();
  const std::vector<int> involved = larger_than(all > kMany ? kWorthNamingWhenMany : kWorthNaming);
  // "exp1." in front of every name is said once, behind them.
  const auto prefix = [&](int i) {
    const std::string& name = name_of(i);
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? std::string() : name.substr(0, dot);
  };
  const bool same_owner = !prefix(involved[0]).empty() && std::ranges::all_of(involved, [&](int i) {
    return prefix(i) == prefix(involved[0]);
  });
  std::string subjects;
  std::string components;
  for (std::size_t k = 0; k < involved.size(); ++k) {
    std::string name = name_of(involved[k]);
    if (same_owner) name = name.substr(prefix(involved[k]).size() + 1);
    if (k > 0) {
      subjects += k + 1 == involved.size() ? " and " : ", ";
      components += ", ";
    }
    subjects += name;
    char value[32];
    std::snprintf(value, sizeof value, " %+.3f", direction(involved[k]));
    components += name + value;
  }
  if (involved.size() < all) {
    components += ", and " + std::to_string(all - involved.size()) + " smaller ones";
  }
  std::string text = subjects;
  if (same_owner) text += " of " + prefix(involved[0]);
  text += involved.size() > 1 ? " trade off along (" + components + ")" : " is free";
  if (std::isfinite(log_std)) {
    char value[64];
    std::snprintf(value, sizeof value, ", held only to %.2g in the logarithm", log_std);
    text += value;
  }
  return text;
}

class Analysis {
 public:
  Analysis(const std::vector<JacobianBlock>& jacobian, const std::vector<std::string>& names,
           const std::vector<bool>& shared)
      : jacobian_(jacobian), names_(names), shared_(shared) {
    result_.covariance = LogCovariance(static_cast<int>(names.size()));
    result_.log_std.assign(names.size(), 0.0);
    double squares = 0.0;
    for (const JacobianBlock& block : jacobian) squares += block.values.squaredNorm();
    least_ = kRankTolerance * std::sqrt(squares);
  }

  // By a singular value decomposition of the whole set.
  void Decompose(const ConnectedSet& set) {
    const SingularValues svd = DecomposeSingular(DenseRows(jacobian_, set.rows, set.columns));
    const auto width = static_cast<Eigen::Index>(set.columns.size());
    Eigen::VectorXd values = Eigen::VectorXd::Zero(width);
    values.head(svd.values.size()) = svd.values;
    Eigen::Index rank = 0;
    while (rank < width && values(rank) > least_) ++rank;
    result_.rank += static_cast<int>(rank);
    const Eigen::MatrixXd determined = svd.v.leftCols(rank);
    const Eigen::MatrixXd scaled = determined * values.head(rank).cwiseInverse().asDiagonal();
    result_.covariance.Add({.blocks = {set.columns},
                            .diagonal = {scaled * scaled.transpose()},
                            .factor = Eigen::MatrixXd(width, 0),
                            .middle = Eigen::MatrixXd(0, 0)});
    for (Eigen::Index k = 0; k < rank; ++k) {
      if (values(k) < 1.0) Report(determined.col(k), set.columns, 1.0 / values(k));
    }
    if (rank < width) Free(svd.v.rightCols(width - rank).transpose(), set.columns);
  }

  // By elimination of what belongs to one experiment.
  void Eliminate(const ConnectedSet& set) {
    Substructure parts = AnalyseSubstructure(jacobian_, set, shared_, least_);
    result_.rank += parts.rank;
    result_.covariance.Add(parts.covariance);
    for (const std::vector<int>& columns : parts.covariance.blocks) {
      const SymmetricEigen eigen = EigenOfSymmetric(result_.covariance.Of(columns));
      for (Eigen::Index k = eigen.values.size(); k-- > 0;) {
        const double variance = eigen.values(k);
        if (variance > 1.0) Report(eigen.vectors.col(k), columns, std::sqrt(variance));
      }
    }
    for (FreeSpace& space : parts.free) Free(std::move(space.rows), space.columns);
  }

  Identifiability Result() {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const int column = static_cast<int>(i);
      double& log_std = result_.log_std[i];
      if (log_std == 0.0) log_std = std::sqrt(result_.covariance(column, column));
    }
    return std::move(result_);
  }

 private:
  void Report(const Eigen::VectorXd& local, const std::vector<int>& columns, double log_std) {
    Eigen::SparseVector<double> direction(static_cast<Eigen::Index>(names_.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      direction.coeffRef(columns[k]) = local(static_cast<Eigen::Index>(k));
    }
    result_.undetermined.push_back({direction, log_std, Describe(local, columns, names_, log_std)});
  }

  // rows: a basis of the directions along which no residual changes.
  void Free(Eigen::MatrixXd rows, const std::vector<int>& columns) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    MakeSparse(rows);
    for (Eigen::Index k = 0; k < rows.rows(); ++k) Report(rows.row(k), columns, kInfinite);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (rows.col(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff() > kNegligible) {
        result_.log_std[static_cast<std::size_t>(columns[i])] = kInfinite;
      }
    }
  }

  const std::vector<JacobianBlock>& jacobian_;
  const std::vector<std::string>& names_;
  const std::vector<bool>& shared_;
  double least_ = 0.0;  // singular values up to this are zero
  Identifiability result_;
};

}  // namespace

Identifiability ComputeIdentifiability(const std::vector<JacobianBlock>& jacobian,
                                       const std::vector<std::string>& names,
                                       const std::vector<bool>& shared, int widest) {
  CHECK_EQ(names.size(), shared.size());
  Analysis analysis(jacobian, names, shared);
  for (const ConnectedSet& set :
       ConnectedColumns(jacobian, static_cast<int>(names.size()), [](int) { return true; })) {
    const bool has_shared = std::ranges::any_of(
        set.columns, [&](int column) { return shared[static_cast<std::size_t>(column)]; });
    if (has_shared && static_cast<int>(set.columns.size()) > widest) {
      analysis.Eliminate(set);
    } else {
      analysis.Decompose(set);
    }
  }
  return analysis.Result();
}

}  // namespace howl
