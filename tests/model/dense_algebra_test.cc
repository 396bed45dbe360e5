#include "model/numerics/dense_algebra.h"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>

namespace howl::dense_algebra_test {
namespace {

Eigen::MatrixXd Hilbert(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd a(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) a(i, j) = 1.0 / static_cast<double>(i + j + 1);
  }
  return a;
}

TEST(Eigenvalues, OfACompanionMatrixAreItsPolynomialsRoots) {
  // (x - 1)(x + 2)(x^2 + 4) = x^4 + x^3 + 2 x^2 + 4 x - 8
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(4, 4);
  companion.bottomLeftCorner(3, 3).setIdentity();
  companion.col(3) << 8.0, -4.0, -2.0, -1.0;
  const Eigen::VectorXcd found = Eigenvalues(companion);
  for (const std::complex<double> root : {std::complex<double>(1, 0), {-2, 0}, {0, 2}, {0, -2}}) {
    const double nearest = (found.array() - root).abs().minCoeff();
    EXPECT_LT(nearest, 1e-12) << root;
  }
}

TEST(SolveByLu, NeedsItsPivots) {
  Eigen::MatrixXd a(2, 2);
  a << 0.0, 2.0, 3.0, 1.0;
  const Eigen::VectorXd x = SolveByLu(a, Eigen::Vector2d(4.0, 5.0));
  EXPECT_DOUBLE_EQ(x(0), 1.0);
  EXPECT_DOUBLE_EQ(x(1), 2.0);
  a << 1.0, 2.0, 2.0, 4.0;
  EXPECT_FALSE(SolveByLu(a, Eigen::Vector2d(1.0, 1.0)).allFinite());
}

// Second differences: 2 - 2 cos(pi k / (n + 1)).
TEST(EigenOfSymmetric, OfSecondDifferences) {
  constexpr int kSize = 6;
  Eigen::MatrixXd a = 2.0 * Eigen::MatrixXd::Identity(kSize, kSize);
  a.diagonal(-1).setConstant(-1.0);  // the upper half is not read
  const SymmetricEigen eigen = EigenOfSymmetric(a);
  a.diagonal(1).setConstant(-1.0);
  for (int k = 0; k < kSize; ++k) {
    EXPECT_NEAR(eigen.values(k), 2.0 - 2.0 * std::cos(std::numbers::pi * (k + 1) / (kSize + 1)),
                1e-14);
  }
  EXPECT_TRUE(HasEigenvaluesAbove(eigen.values(0) - 1e-12, a.triangularView<Eigen::Lower>()));
  EXPECT_FALSE(HasEigenvaluesAbove(eigen.values(0) + 1e-12, a.triangularView<Eigen::Lower>()));
  EXPECT_LT((a * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-13);
  EXPECT_TRUE((eigen.vectors.transpose() * eigen.vectors).isIdentity(1e-13));
}

TEST(GeneralizedEigen, MakesBothDiagonal) {
  const Eigen::MatrixXd a = Hilbert(4, 4);
  const Eigen::MatrixXd b = Eigen::Vector4d(1.0, 2.0, 3.0, 4.0).asDiagonal();
  const SymmetricEigen eigen = GeneralizedEigen(a, b);
  const Eigen::MatrixXd of_a = eigen.vectors.transpose() * a * eigen.vectors;
  const Eigen::MatrixXd of_b = eigen.vectors.transpose() * b * eigen.vectors;
  EXPECT_TRUE(of_a.isApprox(Eigen::MatrixXd(eigen.values.asDiagonal()), 1e-13));
  EXPECT_TRUE(of_b.isIdentity(1e-13));
}

TEST(DecomposeSingular, OfWideAndTallMatricesWithSmallValues) {
  for (const auto& [rows, columns] : {std::pair(7, 4), {4, 7}, {5, 5}}) {
    const Eigen::MatrixXd a = Hilbert(rows, columns);
    const SingularValues svd = DecomposeSingular(a);
    const Eigen::Index least = std::min(rows, columns);
    ASSERT_EQ(svd.values.size(), least);
    ASSERT_EQ(svd.v.cols(), columns);
    EXPECT_TRUE(std::ranges::is_sorted(svd.values, std::greater()));
    EXPECT_TRUE(
        (svd.u * svd.values.asDiagonal() * svd.v.leftCols(least).transpose()).isApprox(a, 1e-14));
    EXPECT_TRUE((svd.v.transpose() * svd.v).isIdentity(1e-13));
  }
}

TEST(OrthonormalColumns, SpanTheSame) {
  const Eigen::MatrixXd a = Hilbert(6, 3);
  const Eigen::MatrixXd q = OrthonormalColumns(a);
  EXPECT_TRUE((q.transpose() * q).isIdentity(1e-13));
  EXPECT_TRUE((q * (q.transpose() * a)).isApprox(a, 1e-13));
}

}  // namespace
}  // namespace howl::dense_algebra_test
