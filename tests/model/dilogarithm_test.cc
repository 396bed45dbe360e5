// The dilogarithm, against its series and against values in closed form.
#include "model/numerics/dilogarithm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "model/numerics/constants.h"

namespace howl::dilogarithm_test {
namespace {

using C = std::complex<double>;

TEST(Dilogarithm, IsTheSumOfItsSeries) {
  for (const double size : {0.0, 0.1, 0.5, 0.9}) {
    for (const double angle : {0.0, 0.7, 1.6, 2.5, 3.1, -1.2}) {
      const C z = std::polar(size, angle);
      C sum = 0.0;
      C power = 1.0;
      for (int n = 1; n < 2000; ++n) {
        power *= z;
        sum += power / static_cast<double>(n * n);
      }
      EXPECT_LT(std::abs(Dilogarithm(z) - sum), std::abs(std::log(1.0 - z)) < 1.5 ? 1e-11 : 1e-6);
    }
  }
}

TEST(Dilogarithm, HasTheValuesInClosedForm) {
  EXPECT_NEAR(Dilogarithm(0.5).real(), kPi * kPi / 12.0 - 0.5 * std::pow(std::numbers::ln2, 2),
              1e-11);
  EXPECT_NEAR(Dilogarithm(-1.0).real(), -kPi * kPi / 12.0, 1e-11);
}

}  // namespace
}  // namespace howl::dilogarithm_test
