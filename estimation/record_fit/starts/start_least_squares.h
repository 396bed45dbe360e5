// Linear least squares with complex rows and real unknowns, as starts of a fit need them.
#ifndef HOWL_ESTIMATION_RECORD_FIT_STARTS_START_LEAST_SQUARES_H_
#define HOWL_ESTIMATION_RECORD_FIT_STARTS_START_LEAST_SQUARES_H_

#include <Eigen/Core>

#include "model/numerics/dense_algebra.h"

namespace howl {

inline constexpr Eigen::Index kStartReach = 20;  // bins, over which weights are smoothed

struct StartSolution {
  Eigen::VectorXd coefficients;
  double left = 0.0;  // |y - X c|^2
};

// X^H X for the unknowns. A column that the others make up for is held near zero.
inline Eigen::MatrixXd GramOfStart(const Eigen::MatrixXcd& x) {
  constexpr double kRidge = 1e-9;  // of the mean square of a column
  Eigen::MatrixXd gram = (x.adjoint() * x).real();
  gram.diagonal().array() += kRidge * gram.diagonal().mean() + 1e-300;
  return gram;
}

// min |y - X c|^2.
inline StartSolution SolveStart(const Eigen::MatrixXcd& x, const Eigen::VectorXcd& y) {
  const Eigen::VectorXd cross = (x.adjoint() * y).real();
  StartSolution out;
  out.coefficients = SolveSymmetric(GramOfStart(x), cross);
  out.left = y.squaredNorm() - cross.dot(out.coefficients);
  return out;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_STARTS_START_LEAST_SQUARES_H_
