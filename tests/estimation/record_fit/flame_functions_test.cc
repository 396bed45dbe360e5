// What a flame's curve may be before a record is seen.
#include "estimation/record_fit/spectra/flame_functions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace howl::flame_functions_test {
namespace {

constexpr double kRange = 1.7;

// Any spectra do: here those of splines that are reached in their order, more and more seldom.
Eigen::MatrixXcd SomeSpectra() {
  Eigen::MatrixXcd out(40, kFlameTerms);
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    for (Eigen::Index k = 0; k < out.cols(); ++k) {
      const auto turn = static_cast<double>((i + 1) * (k + 1));
      out(i, k) = std::polar(1.0 + std::sin(0.7 * turn), 0.3 * turn);
    }
  }
  return out;
}

double Matern(double distance) {
  const double x = std::sqrt(5.0) * distance;
  return (1.0 + x + x * x / 3.0) * std::exp(-x);
}

TEST(FlameFunctions, AreOrthogonalOverTheRecord) {
  const Eigen::MatrixXcd spectra = SomeSpectra();
  const FlameFunctions flame = SmoothFlames({}, FlameBasis(kRange), spectra, 1.0);
  const Eigen::MatrixXcd of_functions = spectra * flame.of_splines;
  const Eigen::MatrixXd gram = (of_functions.adjoint() * of_functions).real() / 40.0;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).norm(), 1e-6);
  for (Eigen::Index k = 1; k < flame.deviation.size(); ++k) {
    EXPECT_LE(flame.deviation[k], flame.deviation[k - 1]);
  }
}

// Of the curve's values at two knots, less that at the last: the process' own.
TEST(FlameFunctions, HaveTheCovarianceOfTheProcess) {
  const FlameBasis basis(kRange);
  const FlameFunctions flame = SmoothFlames({}, basis, SomeSpectra(), 1.0);
  const Eigen::MatrixXd scaled = flame.of_splines * flame.deviation.asDiagonal();
  const Eigen::MatrixXd covariance = scaled * scaled.transpose();
  const Eigen::VectorXd v = basis.Knots();
  const double last = v[kFlameTerms];
  for (Eigen::Index i = 0; i < kFlameTerms; ++i) {
    for (Eigen::Index j = 0; j < kFlameTerms; ++j) {
      const double of_slope = 9.0 * (v[i] - last) * (v[j] - last);
      const double of_rest = Matern(std::abs(v[i] - v[j])) - Matern(std::abs(v[i] - last)) -
                             Matern(std::abs(v[j] - last)) + 1.0;
      EXPECT_NEAR(covariance(i, j), of_slope + of_rest, 1e-3) << i << ' ' << j;
    }
  }
}

// A straight line is a curve at whose knots the values are the line's.
TEST(FlameFunctions, KnotsAreWhereALineHasItsCoefficients) {
  const FlameBasis basis(kRange);
  const Eigen::VectorXd knots = basis.Knots();
  const Eigen::VectorXd line = 2.0 * (knots.head(kFlameTerms).array() - knots[kFlameTerms]);
  for (const double v : {-1.6, -0.3, 0.0, 0.9, 1.6}) {
    EXPECT_NEAR(basis.At(v, line), 2.0 * (v - knots[kFlameTerms]), 1e-12);
  }
}

}  // namespace
}  // namespace howl::flame_functions_test
