#include "model/numerics/dense_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace howl {

Eigen::VectorXcd Eigenvalues(const Eigen::MatrixXd& a) { return a.eigenvalues(); }

Eigen::VectorXd SolveByLu(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.partialPivLu().solve(b);
}

}  // namespace howl
