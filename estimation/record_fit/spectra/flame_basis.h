// The flame's characteristic without a shape assumed: cubic B-splines on even knots over the range
// of v, linear in the coefficients. One of them is left out, since no constant in q is recorded.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_FLAME_BASIS_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_FLAME_BASIS_H_

#include <Eigen/Core>

namespace howl {

inline constexpr Eigen::Index kFlameTerms = 9;

class FlameBasis {
 public:
  explicit FlameBasis(double range) : range_(range) {}

  // Where each of all kFlameTerms + 1 splines has its middle: a curve's coefficients are its values
  // there, but for its curvature.
  Eigen::VectorXd Knots() const;
  // samples x kFlameTerms
  Eigen::MatrixXd Columns(const Eigen::VectorXd& v) const;
  // Of each column's mean by v, where all of v rises alike: kFlameTerms.
  Eigen::VectorXd MeanSlopes(const Eigen::VectorXd& v) const;
  // The sum of the columns times the coefficients.
  double At(double v, const Eigen::VectorXd& coefficients) const;
  Eigen::VectorXd Value(const Eigen::VectorXd& v, const Eigen::VectorXd& coefficients) const;

 private:
  double range_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_FLAME_BASIS_H_
