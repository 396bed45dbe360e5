// Products against sums that are taken one product after the other.
#include "model/numerics/transposed_product.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <tuple>

namespace howl::transposed_product_test {
namespace {

// Rows; columns of a; columns of b.
class TransposedProduct
    : public testing::TestWithParam<std::tuple<Eigen::Index, Eigen::Index, Eigen::Index>> {
 protected:
  TransposedProduct() {
    const auto [rows, of_a, of_b] = GetParam();
    // Parts of larger matrices, whose other entries must not come in.
    a_ = Eigen::MatrixXd::Random(rows + 3, of_a + 2);
    b_ = Eigen::MatrixXd::Random(rows + 3, of_b + 2);
    c_ = Eigen::MatrixXd::Random(of_a + 2, of_b + 2);
  }

  Eigen::MatrixXd a_, b_, c_;
};

TEST_P(TransposedProduct, IsTheSumOverRows) {
  const auto [rows, of_a, of_b] = GetParam();
  Eigen::MatrixXd expected = c_;
  for (Eigen::Index i = 0; i < of_a; ++i) {
    for (Eigen::Index j = 0; j < of_b; ++j) {
      for (Eigen::Index row = 0; row < rows; ++row) {
        expected(1 + i, 1 + j) += a_(2 + row, 1 + i) * b_(1 + row, 2 + j);
      }
    }
  }
  AddTransposedProduct(a_.block(2, 1, rows, of_a), b_.block(1, 2, rows, of_b),
                       c_.block(1, 1, of_a, of_b));
  EXPECT_LE((c_ - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(TransposedProduct, OfTheUpperHalfLeavesTheLower) {
  const auto [rows, of_a, of_b] = GetParam();
  if (of_a != of_b) return;
  Eigen::MatrixXd expected = c_;
  for (Eigen::Index i = 0; i < of_a; ++i) {
    for (Eigen::Index j = i; j < of_b; ++j) {
      expected(1 + i, 1 + j) +=
          a_.block(2, 1 + i, rows, 1).cwiseProduct(b_.block(1, 2 + j, rows, 1)).sum();
    }
  }
  AddUpperOfTransposedProduct(a_.block(2, 1, rows, of_a), b_.block(1, 2, rows, of_b),
                              c_.block(1, 1, of_a, of_b));
  EXPECT_LE((c_ - expected).cwiseAbs().maxCoeff(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Sizes, TransposedProduct,
                         testing::Values(std::tuple(256, 8, 8), std::tuple(256, 7, 5),
                                         std::tuple(67, 13, 13), std::tuple(5, 1, 1),
                                         std::tuple(8, 4, 2), std::tuple(0, 3, 3),
                                         std::tuple(16, 0, 4), std::tuple(16, 4, 0),
                                         std::tuple(64, 3, 3), std::tuple(100, 30, 41)));

}  // namespace
}  // namespace howl::transposed_product_test
