// Values with half of their 95 % interval, as the report writes them.
#include "io/report/spelled_interval.h"

#include <gtest/gtest.h>

#include <cmath>

namespace howl::spelled_interval_test {
namespace {

// The half width is given; 1.96 standard deviations of the normal distribution.
std::string Spelled95(double value, double half, double scale = 1.0) {
  return SpelledInterval({value, half / 1.959964}, scale);
}

TEST(SpelledInterval, EndsAtTheDecimalOfTheHalfWidth) {
  EXPECT_EQ(Spelled95(219.66412, 0.0171), "219.664 ± 0.017");
  EXPECT_EQ(Spelled95(219.66412, 0.0096), "219.664 ± 0.010");
  EXPECT_EQ(Spelled95(219.66412, 0.052), "219.66 ± 0.05");
  EXPECT_EQ(Spelled95(-5.7366, 0.19), "−5.74 ± 0.19");
  EXPECT_EQ(Spelled95(339.2, 23.0), "339 ± 23");
  EXPECT_EQ(Spelled95(0.0001, 0.0536), "0.00 ± 0.05");
}

TEST(SpelledInterval, OnePowerOfTenForBoth) {
  EXPECT_EQ(Spelled95(-7.0231e-5, 1.1e-7), "(−7.023 ± 0.011) · 10⁻⁵");
  EXPECT_EQ(Spelled95(-9.07e-4, 4.1e-5), "(−9.1 ± 0.4) · 10⁻⁴");
  EXPECT_EQ(Spelled95(3.3381e-3, 2.4e-7, 1e3), "3.33810 ± 0.00024");
  EXPECT_EQ(Spelled95(2.5e6, 1.3e4), "(2.500 ± 0.013) · 10⁶");
}

TEST(SpelledInterval, WithoutAnErrorTheValueAlone) {
  EXPECT_EQ(SpelledInterval({12.14, NAN}), "12.14");
  EXPECT_EQ(SpelledInterval({12.14, 0.0}), "12.14");
  EXPECT_EQ(SpelledInterval({NAN, NAN}), "–");
}

}  // namespace
}  // namespace howl::spelled_interval_test
