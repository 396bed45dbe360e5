// Solves h x = g with h scaled to a diagonal of ones, to which `damping` is added. It serves normal
// equations whose unknowns have unlike units.
#ifndef HOWL_DIAGNOSIS_NUMERICS_SCALED_SOLVE_H_
#define HOWL_DIAGNOSIS_NUMERICS_SCALED_SOLVE_H_

#include <Eigen/Core>

namespace howl {

// g: one right-hand side in each column. An unknown of which h tells nothing, with a zero on the
// diagonal, is zero.
Eigen::MatrixXd SolveScaled(const Eigen::MatrixXd& h, const Eigen::MatrixXd& g, double damping);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NUMERICS_SCALED_SOLVE_H_
