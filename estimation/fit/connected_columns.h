// Sets of columns of a Jacobian that chains of rows connect, and the rows of such a set.
#ifndef HOWL_ESTIMATION_FIT_CONNECTED_COLUMNS_H_
#define HOWL_ESTIMATION_FIT_CONNECTED_COLUMNS_H_

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "estimation/fit/jacobian_block.h"

namespace howl {

// One set: its columns, ascending, and the rows of J with an entry in one of them, as (block, row
// of the block). A column that no row touches is a set of its own.
struct ConnectedSet {
  std::vector<int> columns;
  std::vector<std::pair<int, int>> rows;
};

// The sets of the columns that `counts` accepts, in the order of their first columns; other columns
// connect nothing.
std::vector<ConnectedSet> ConnectedColumns(const std::vector<JacobianBlock>& jacobian, int columns,
                                           const std::function<bool(int)>& counts);

// The rows of a set over `columns`, which need not be the set's; at least one row, of zeros.
Eigen::MatrixXd DenseRows(const std::vector<JacobianBlock>& jacobian,
                          const std::vector<std::pair<int, int>>& rows,
                          const std::vector<int>& columns);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_CONNECTED_COLUMNS_H_
