// The rows of a joint problem's Jacobian that belong to one experiment, and the columns that they
// touch: its own parameters, what experiments share, and a neighbour's xi. All experiments' blocks
// together are J; their number of entries grows as the number of experiments does.
#ifndef HOWL_ESTIMATION_FIT_JACOBIAN_BLOCK_H_
#define HOWL_ESTIMATION_FIT_JACOBIAN_BLOCK_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/residual_spec.h"

namespace howl {

struct JacobianBlock {
  std::vector<int> columns;         // of J, ascending
  Eigen::MatrixXd values;           // rows x columns.size()
  Eigen::VectorXd residuals;        // one a row
  std::vector<ResidualKind> kinds;  // one a row
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_JACOBIAN_BLOCK_H_
