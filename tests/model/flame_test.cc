#include "model/flame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace howl {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr FlameShape kSaturating[] = {FlameShape::kTanh, FlameShape::kArctan, FlameShape::kCubic,
                                      FlameShape::kPiecewiseLinear, FlameShape::kAlgebraic};

TEST(Flame, SlopeAtZeroSaturationAndOddness) {
  for (const FlameShape shape : kSaturating) {
    const Flame<double> flame{shape, -0.7e-4, 0.5, 0.0};
    EXPECT_EQ(FlameResponse(flame, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(FlameSlope(flame, 0.0), -0.7e-4);
    EXPECT_NEAR(FlameResponse(flame, -1e12), 0.5, 1e-6);
    EXPECT_DOUBLE_EQ(FlameResponse(flame, 3000.0), -FlameResponse(flame, -3000.0));
  }
}

TEST(Flame, SlopeIsTheDerivative) {
  for (const FlameShape shape : kSaturating) {
    const Flame<double> flame{shape, -0.7e-4, 0.5, 900.0};
    for (double v = -20000.0; v < 20000.0; v += 777.0) {
      const double h = 1e-2;
      const double difference =
          (FlameResponse(flame, v + h) - FlameResponse(flame, v - h)) / (2 * h);
      EXPECT_NEAR(FlameSlope(flame, v), difference, 1e-11);
    }
  }
}

// Gelb & Van der Velde 1968, appendix B; a = |k| A / Q.
TEST(Flame, DescribingFunctionsInClosedForm) {
  constexpr double kSlope = -0.7e-4;
  constexpr double kSaturation = 0.5;
  for (const double a : {0.2, 0.9, 1.4, 3.0, 20.0}) {
    const double amplitude = a * kSaturation / -kSlope;
    const auto value = [&](FlameShape shape) {
      return DescribingFunction(Flame<double>{shape, kSlope, kSaturation, 0.0}, amplitude,
                                1 << 14) /
             kSlope;
    };
    const double linear =
        a <= 1.0 ? 1.0 : 2.0 / kPi * (std::asin(1.0 / a) + std::sqrt(1.0 - 1.0 / (a * a)) / a);
    EXPECT_NEAR(value(FlameShape::kPiecewiseLinear), linear, 1e-6);
    if (a <= 1.5) {
      EXPECT_NEAR(value(FlameShape::kCubic), 1.0 - a * a / 9.0, 1e-12);
    }
    // (2 / pi) arctan(b x), b = pi / 2.
    const double b = kPi / 2.0;
    EXPECT_NEAR(value(FlameShape::kArctan),
                2.0 / kPi * 2.0 * (std::sqrt(1.0 + b * b * a * a) - 1.0) / (b * a * a), 1e-12);
    EXPECT_NEAR(value(FlameShape::kLinear), 1.0, 1e-12);
  }
  // Far in saturation every shape is a relay: 4 Q / (pi A).
  for (const FlameShape shape : kSaturating) {
    const double a = 1e4;
    EXPECT_NEAR(
        DescribingFunction(Flame<double>{shape, -1.0, 1.0, 0.0}, a, 1 << 20) / (-4.0 / (kPi * a)),
        1.0, 1e-3);
  }
}

TEST(Flame, OffsetMovesTheCurve) {
  const Flame<double> centred{FlameShape::kTanh, -0.7e-4, 0.5, 0.0};
  const Flame<double> moved{FlameShape::kTanh, -0.7e-4, 0.5, -1500.0};
  EXPECT_DOUBLE_EQ(FlameResponse(moved, 500.0), FlameResponse(centred, 2000.0));
  EXPECT_LT(std::abs(FlameSlope(moved, 0.0)), 0.7e-4);
}

}  // namespace
}  // namespace howl
