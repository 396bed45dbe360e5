// Re(A^H W B): the normal equations of a complex least-squares problem in real unknowns. Real and
// imaginary parts are taken as rows of their own, which halves the products of the complex form.
#ifndef HOWL_DIAGNOSIS_NUMERICS_REAL_GRAM_H_
#define HOWL_DIAGNOSIS_NUMERICS_REAL_GRAM_H_

#include <Eigen/Core>

namespace howl {

// a: n x k, b: n x m, weight: n; k x m.
Eigen::MatrixXd RealGram(const Eigen::VectorXd& weight, const Eigen::MatrixXcd& a,
                         const Eigen::MatrixXcd& b);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NUMERICS_REAL_GRAM_H_
