// The simulator's tanh against tanh in extended precision.
#include "model/numerics/fast_tanh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace howl::fast_tanh_test {
namespace {

TEST(FastTanh, WithinThreeUnitsInTheLastPlace) {
  double worst = 0.0;
  double worst_at = 0.0;
  // From denormals to saturation, a few hundred thousand points with no pattern in their bits.
  for (double x = 1e-310; x < 30.0; x *= 1.0037) {
    for (int i = 0; i < 8; ++i) {
      const double at = x * (1.0 + 0.00046123 * i);
      const long double truth = std::tanh(static_cast<long double>(at));
      const auto rounded = static_cast<double>(truth);
      const double unit = std::nextafter(rounded, 2.0) - rounded;
      const auto error =
          static_cast<double>(std::abs(static_cast<long double>(FastTanh(at)) - truth)) / unit;
      if (error > worst) {
        worst = error;
        worst_at = at;
      }
      ASSERT_EQ(FastTanh(-at), -FastTanh(at)) << at;
    }
  }
  std::printf("tanh: at most %.2f units in the last place\n", worst);
  EXPECT_LT(worst, 3.0) << "at " << worst_at;
}

TEST(FastTanh, Limits) {
  EXPECT_EQ(FastTanh(0.0), 0.0);
  EXPECT_TRUE(std::signbit(FastTanh(-0.0)));
  EXPECT_EQ(FastTanh(25.0), 1.0);
  EXPECT_EQ(FastTanh(-std::numeric_limits<double>::infinity()), -1.0);
  EXPECT_TRUE(std::isnan(FastTanh(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace howl::fast_tanh_test
