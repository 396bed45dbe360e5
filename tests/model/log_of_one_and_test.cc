#include "model/numerics/log_of_one_and.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace howl::log_of_one_and_test {
namespace {

using Long = std::complex<long double>;

// By its series where w is small, as in 1 + w its last digits are lost.
Long Exact(Long w) {
  if (std::abs(w) > 1e-2L) return std::log(1.0L + w);
  Long sum = 0.0L;
  for (int n = 12; n >= 1; --n) sum = w * ((n % 2 == 1 ? 1.0L : -1.0L) / n + sum);
  return sum;
}

// Around the unit circle, near the zero of 1 + w, and for w as small as any, against long double.
TEST(LogOfOneAnd, IsRightToRounding) {
  constexpr double kRounding = 4e-16;
  for (const double size : {1e-12, 1e-6, 1e-3, 0.1, 0.9, 0.999, 1.0, 1.1, 2.0, 50.0}) {
    for (int turn = 0; turn < 64; ++turn) {
      const std::complex<double> w = std::polar(size, (turn + 0.3) * std::numbers::pi / 32.0);
      const Long exact = Exact(Long(w));
      const std::complex<double> found = LogOfOneAnd(w);
      // Of |1 + w| what rounding of w leaves where the two nearly cancel.
      const double near_zero = std::abs(1.0 + w);
      const double least = kRounding * (std::abs(w) + 2.0 * std::abs(w) / near_zero);
      EXPECT_NEAR(found.real(), static_cast<double>(exact.real()), least) << w;
      EXPECT_NEAR(found.imag(), static_cast<double>(exact.imag()), least) << w;
    }
  }
}

}  // namespace
}  // namespace howl::log_of_one_and_test
