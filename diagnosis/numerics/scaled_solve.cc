#include "diagnosis/numerics/scaled_solve.h"

#include <Eigen/Cholesky>

namespace howl {

Eigen::MatrixXd SolveScaled(const Eigen::MatrixXd& h, const Eigen::MatrixXd& g, double damping) {
  const Eigen::VectorXd scale = h.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * h * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  return scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * g);
}

}  // namespace howl
