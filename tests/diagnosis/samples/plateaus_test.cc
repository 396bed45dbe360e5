#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/samples/sample_limits.h"

namespace howl::plateaus_test {
namespace {

TEST(FindPlateaus, OneEndTwoEndsOrNone) {
  Eigen::VectorXd x(4000);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = std::sin(0.0731 * static_cast<double>(i)) + 0.1 * std::sin(1.37 * double(i));
  }
  EXPECT_EQ(FindPlateaus(x).upper.sum() + FindPlateaus(x).lower.sum(), 0.0);
  const Eigen::VectorXd one = x.cwiseMin(0.8);
  EXPECT_EQ(FindPlateaus(one).upper.sum(), static_cast<double>((x.array() >= 0.8).count()));
  EXPECT_EQ(FindPlateaus(one).lower.sum(), 0.0);
  const Eigen::VectorXd two = one.cwiseMax(-0.7);
  EXPECT_EQ(FindPlateaus(two).lower.sum(), static_cast<double>((x.array() <= -0.7).count()));
}

}  // namespace
}  // namespace howl::plateaus_test
