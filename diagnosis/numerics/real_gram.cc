#include "diagnosis/numerics/real_gram.h"

namespace howl {

Eigen::MatrixXd RealGram(const Eigen::VectorXd& weight, const Eigen::MatrixXcd& a,
                         const Eigen::MatrixXcd& b) {
  using RealView = Eigen::Map<const Eigen::MatrixXd>;
  const RealView left(reinterpret_cast<const double*>(a.data()), 2 * a.rows(), a.cols());
  const RealView right(reinterpret_cast<const double*>(b.data()), 2 * b.rows(), b.cols());
  Eigen::VectorXd twice(2 * weight.size());
  for (Eigen::Index k = 0; k < weight.size(); ++k) twice[2 * k] = twice[2 * k + 1] = weight[k];
  const Eigen::MatrixXd weighted = twice.asDiagonal() * left;
  return weighted.transpose() * right;
}

}  // namespace howl
