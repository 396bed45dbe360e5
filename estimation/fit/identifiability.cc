#include "estimation/fit/identifiability.h"

#include <glog/logging.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

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

// Columns of J that no chain of residuals connects belong to different blocks.
std::vector<std::vector<int>> ConnectedColumns(const Eigen::MatrixXd& jacobian) {
  const int n = static_cast<int>(jacobian.cols());
  std::vector<int> parent(static_cast<std::size_t>(n));
  std::iota(parent.begin(), parent.end(), 0);
  const std::function<int(int)> root = [&](int i) {
    int& p = parent[static_cast<std::size_t>(i)];
    return p == i ? i : p = root(p);
  };
  for (int row = 0; row < jacobian.rows(); ++row) {
    int first = -1;
    for (int column = 0; column < n; ++column) {
      if (jacobian(row, column) == 0.0) continue;
      if (first < 0) {
        first = column;
      } else {
        parent[static_cast<std::size_t>(root(column))] = root(first);
      }
    }
  }
  std::map<int, std::vector<int>> groups;
  for (int column = 0; column < n; ++column) groups[root(column)].push_back(column);
  std::vector<std::vector<int>> result;
  for (auto& [key, columns] : groups) result.push_back(std::move(columns));
  std::ranges::sort(result);
  return result;
}

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

std::string Describe(const Eigen::VectorXd& direction, const std::vector<std::string>& names,
                     double log_std) {
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
    const std::string& name = names[static_cast<std::size_t>(i)];
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? std::string() : name.substr(0, dot);
  };
  const bool same_owner = !prefix(involved[0]).empty() && std::ranges::all_of(involved, [&](int i) {
    return prefix(i) == prefix(involved[0]);
  });
  std::string subjects;
  std::string components;
  for (std::size_t k = 0; k < involved.size(); ++k) {
    std::string name = names[static_cast<std::size_t>(involved[k])];
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

}  // namespace

Identifiability ComputeIdentifiability(const Eigen::MatrixXd& jacobian,
                                       const std::vector<std::string>& names) {
  const Eigen::Index n = jacobian.cols();
  CHECK_EQ(static_cast<std::size_t>(n), names.size());
  Identifiability result;
  result.covariance = Eigen::MatrixXd::Zero(n, n);
  result.log_std.assign(static_cast<std::size_t>(n), 0.0);
  if (n == 0) return result;
  const double scale = jacobian.norm();
  std::vector<double> singular_values;
  const auto report = [&](const Eigen::VectorXd& local, const std::vector<int>& columns,
                          double log_std) {
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(n);
    direction(columns) = local;
    result.undetermined.push_back({direction, log_std, Describe(direction, names, log_std)});
  };
  for (const std::vector<int>& columns : ConnectedColumns(jacobian)) {
    const Eigen::MatrixXd block = jacobian(Eigen::all, columns);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(block, Eigen::ComputeFullV);
    const Eigen::Index width = block.cols();
    Eigen::VectorXd values = Eigen::VectorXd::Zero(width);
    values.head(svd.singularValues().size()) = svd.singularValues();
    Eigen::Index rank = 0;
    while (rank < width && values(rank) > kRankTolerance * scale) ++rank;
    result.rank += static_cast<int>(rank);
    singular_values.insert(singular_values.end(), values.begin(), values.end());

    const Eigen::MatrixXd determined = svd.matrixV().leftCols(rank);
    const Eigen::MatrixXd scaled = determined * values.head(rank).cwiseInverse().asDiagonal();
    result.covariance(columns, columns) = scaled * scaled.transpose();
    for (Eigen::Index k = 0; k < rank; ++k) {
      if (values(k) < 1.0) report(determined.col(k), columns, 1.0 / values(k));
    }
    if (rank == width) continue;
    Eigen::MatrixXd free_rows = svd.matrixV().rightCols(width - rank).transpose();
    MakeSparse(free_rows);
    for (Eigen::Index k = 0; k < free_rows.rows(); ++k) {
      report(free_rows.row(k), columns, std::numeric_limits<double>::infinity());
    }
    for (Eigen::Index i = 0; i < width; ++i) {
      if (free_rows.col(i).cwiseAbs().maxCoeff() > kNegligible) {
        result.log_std[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])] =
            std::numeric_limits<double>::infinity();
      }
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    double& log_std = result.log_std[static_cast<std::size_t>(i)];
    if (log_std == 0.0) log_std = std::sqrt(result.covariance(i, i));
  }
  std::ranges::sort(singular_values, std::greater<>());
  result.singular_values = Eigen::Map<Eigen::VectorXd>(singular_values.data(), n);
  return result;
}

}  // namespace howl
