#include "diagnosis/numerics/scaled_solve.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace howl {

Eigen::MatrixXd SolveScaled(const Eigen::MatrixXd& h, const Eigen::MatrixXd& g, double damping) {
  const Eigen::VectorXd scale = h.diagonal().unaryExpr(
      [](double curvature) { return curvature > 0.0 ? 1.0 / std::sqrt(curvature) : 0.0; });
  Eigen::MatrixXd scaled = scale.asDiagonal() * h * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  return scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * g);
}

}  // namespace howl
