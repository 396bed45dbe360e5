#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "model/numerics/dense_algebra.h"

namespace howl {

Eigen::MatrixXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.ldlt().solve(b);
}

bool HasEigenvaluesAbove(double least, Eigen::MatrixXd a) {
  a.diagonal().array() -= least;
  return a.llt().info() == Eigen::Success;
}

SymmetricEigen EigenOfSymmetric(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen GeneralizedEigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, b);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace howl
