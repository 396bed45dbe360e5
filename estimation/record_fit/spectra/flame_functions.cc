#include "estimation/record_fit/spectra/flame_functions.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

// Functions that a curve hardly holds are left out.
constexpr double kLeastOfLargest = 3e-4;
constexpr double kJitter = 1e-9;

Eigen::MatrixXd CovarianceOfValues(const FlamePrior& prior, const Eigen::VectorXd& v,
                                   double input) {
  Eigen::MatrixXd out(v.size(), v.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    for (Eigen::Index j = 0; j < v.size(); ++j) {
      const double x = std::sqrt(5.0) * std::abs(v[i] - v[j]) / (prior.length * input);
      out(i, j) = prior.slope * prior.slope * v[i] * v[j] / (input * input) +
                  prior.size * prior.size * (1.0 + x + x * x / 3.0) * std::exp(-x);
    }
  }
  return out;
}

}  // namespace

FlameFunctions SmoothFlames(const FlamePrior& prior, const FlameBasis& basis,
                            const Eigen::MatrixXcd& spectra, double input) {
  // The last spline's coefficient is zero: the curve is known but for a constant.
  Eigen::MatrixXd difference(kFlameTerms, kFlameTerms + 1);
  difference << Eigen::MatrixXd::Identity(kFlameTerms, kFlameTerms),
      -Eigen::VectorXd::Ones(kFlameTerms);
  Eigen::MatrixXd covariance =
      difference * CovarianceOfValues(prior, basis.Knots(), input) * difference.transpose();
  covariance.diagonal().array() += kJitter * covariance.diagonal().mean();
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  const Eigen::MatrixXcd drawn = spectra * root;
  const SymmetricEigen eigen =
      EigenOfSymmetric((drawn.adjoint() * drawn).real() / static_cast<double>(spectra.rows()));
  const Eigen::VectorXd deviation = eigen.values.cwiseMax(0.0).cwiseSqrt().reverse();
  const Eigen::Index kept = (deviation.array() > kLeastOfLargest * deviation[0]).count();
  FlameFunctions out;
  out.deviation = deviation.head(kept);
  out.of_splines = root * eigen.vectors.rowwise().reverse().leftCols(kept) *
                   out.deviation.cwiseInverse().asDiagonal();
  return out;
}

}  // namespace howl
