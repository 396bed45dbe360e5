// Solves h x = g with h scaled to a diagonal of ones, to which `damping` is added. It serves normal
// equations whose unknowns have unlike units.
#ifndef HOWL_DIAGNOSIS_SCALED_SOLVE_H_
#define HOWL_DIAGNOSIS_SCALED_SOLVE_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace howl {

// g: one right-hand side in each column.
inline Eigen::MatrixXd SolveScaled(const Eigen::MatrixXd& h, const Eigen::MatrixXd& g,
                                   double damping) {
  const Eigen::VectorXd scale = h.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * h * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  return scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * g);
}

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SCALED_SOLVE_H_
