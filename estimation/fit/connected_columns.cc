#include "estimation/fit/connected_columns.h"

#include <algorithm>
#include <numeric>

namespace howl {

std::vector<ConnectedSet> ConnectedColumns(const std::vector<JacobianBlock>& jacobian, int columns,
                                           const std::function<bool(int)>& counts) {
  const auto n = static_cast<std::size_t>(columns);
  std::vector<int> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      int& above = parent[static_cast<std::size_t>(i)];
      above = parent[static_cast<std::size_t>(above)];
      i = above;
    }
    return i;
  };
  std::vector<bool> accepted(n);
  for (int column = 0; column < columns; ++column) {
    accepted[static_cast<std::size_t>(column)] = counts(column);
  }
  // The first accepted column with an entry in the row; -1: none.
  const auto first_of = [&](const JacobianBlock& block, Eigen::Index row) {
    for (std::size_t k = 0; k < block.columns.size(); ++k) {
      const int column = block.columns[k];
      if (!accepted[static_cast<std::size_t>(column)]) continue;
      if (block.values(row, static_cast<Eigen::Index>(k)) != 0.0) return column;
    }
    return -1;
  };
  for (const JacobianBlock& block : jacobian) {
    for (Eigen::Index row = 0; row < block.values.rows(); ++row) {
      const int first = first_of(block, row);
      if (first < 0) continue;
      for (std::size_t k = 0; k < block.columns.size(); ++k) {
        const int column = block.columns[k];
        if (!accepted[static_cast<std::size_t>(column)]) continue;
        if (block.values(row, static_cast<Eigen::Index>(k)) == 0.0) continue;
        // The lower root stays one, so that sets come in the order of their first columns.
        const int a = root(first), b = root(column);
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      }
    }
  }
  std::vector<ConnectedSet> sets;
  std::vector<std::size_t> set_of(n);
  for (int column = 0; column < columns; ++column) {
    if (!accepted[static_cast<std::size_t>(column)]) continue;
    const int top = root(column);
    if (top == column) {
      set_of[static_cast<std::size_t>(column)] = sets.size();
      sets.emplace_back();
    }
    sets[set_of[static_cast<std::size_t>(top)]].columns.push_back(column);
  }
  for (std::size_t block = 0; block < jacobian.size(); ++block) {
    for (Eigen::Index row = 0; row < jacobian[block].values.rows(); ++row) {
      const int first = first_of(jacobian[block], row);
      if (first < 0) continue;
      sets[set_of[static_cast<std::size_t>(root(first))]].rows.emplace_back(static_cast<int>(block),
                                                                            static_cast<int>(row));
    }
  }
  return sets;
}

Eigen::MatrixXd DenseRows(const std::vector<JacobianBlock>& jacobian,
                          const std::vector<std::pair<int, int>>& rows,
                          const std::vector<int>& columns) {
  Eigen::MatrixXd dense =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(std::max<std::size_t>(rows.size(), 1)),
                            static_cast<Eigen::Index>(columns.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const JacobianBlock& block = jacobian[static_cast<std::size_t>(rows[r].first)];
    for (std::size_t k = 0; k < block.columns.size(); ++k) {
      const auto at = std::ranges::lower_bound(columns, block.columns[k]);
      if (at == columns.end() || *at != block.columns[k]) continue;
      dense(static_cast<Eigen::Index>(r), at - columns.begin()) =
          block.values(rows[r].second, static_cast<Eigen::Index>(k));
    }
  }
  return dense;
}

}  // namespace howl
