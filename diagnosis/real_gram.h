// Re(A^H W B): the normal equations of a complex least-squares problem in real unknowns. Real and
// imaginary parts are taken as rows of their own, which halves the products of the complex form.
#ifndef HOWL_DIAGNOSIS_REAL_GRAM_H_
#define HOWL_DIAGNOSIS_REAL_GRAM_H_

#include <Eigen/Core>

namespace howl {

// a: n x k, b: n x m, weight: n; k x m.
inline Eigen::MatrixXd RealGram(const Eigen::VectorXd& weight, const Eigen::MatrixXcd& a,
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

#endif  // HOWL_DIAGNOSIS_REAL_GRAM_H_
