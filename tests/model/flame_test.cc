#include "model/loop/flame.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <numbers>

#include "model/numerics/constants.h"

namespace howl::flame_test {
namespace {

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

// K (sqrt|1/3 + u| - sqrt(1/3)), the Rijke tube's heat release, with k = K sqrt(3) / 2, Q = k / 3.
TEST(Flame, SquareRootIsKingsLaw) {
  constexpr double kStrength = 0.72;
  const double slope = kStrength * std::sqrt(3.0) / 2.0;
  const Flame<double> flame{FlameShape::kSquareRoot, slope, slope / 3.0, 0.0};
  for (const double u : {-2.0, -0.5, -1.0 / 3.0, -0.3, 0.0, 0.1, 3.0}) {
    const double king = kStrength * (std::sqrt(std::abs(1.0 / 3.0 + u)) - std::sqrt(1.0 / 3.0));
    EXPECT_NEAR(FlameResponse(flame, u), king, 1e-7) << u;  // the cusp magnifies rounding
  }
  for (const double u : {-2.0, -0.5, -0.3, 0.0, 0.1, 3.0}) {
    const double stream = 1.0 / 3.0 + u;
    const double expected =
        0.5 * kStrength * std::copysign(1.0, stream) / std::sqrt(std::abs(stream));
    EXPECT_NEAR(FlameSlope(flame, u), expected, 1e-12 * std::abs(expected)) << u;
  }
  EXPECT_TRUE(std::isfinite(FlameSlope(flame, -1.0 / 3.0)));
}

// Over the slope, at a = |k| A / Q: 2 / (pi a) times the integral of sqrt|1 + a sin t| sin t over a
// turn. Up to a = 1 that is 4 sqrt(1 + a) / (3 a) (E(m) - (1 - a) K(m)), m = 2 a / (1 + a),
// complete elliptic integrals; beyond, tanh-sinh quadrature between the cusps.
TEST(Flame, DescribingFunctionOfTheSquareRoot) {
  const auto value = [](double a) {
    const Flame<double> flame{FlameShape::kSquareRoot, -0.7e-4, 0.5, 0.0};
    return DescribingFunction(flame, a * 0.5 / 0.7e-4, 1 << 18) / -0.7e-4;
  };
  for (const double a : {0.05, 0.3, 0.9, 1.0}) {
    const double modulus = std::sqrt(2.0 * a / (1.0 + a));
    const double first = a < 1.0 ? (1.0 - a) * boost::math::ellint_1(modulus) : 0.0;
    const double integral =
        4.0 * std::sqrt(1.0 + a) / (3.0 * a) * (boost::math::ellint_2(modulus) - first);
    EXPECT_NEAR(value(a), 2.0 * integral / (kPi * a), 1e-9) << a;
  }
  EXPECT_NEAR(value(1.0), 8.0 * std::numbers::sqrt2 / (3.0 * kPi), 1e-9);  // E(1) = 1
  for (const double a : {1.05, 1.4, 3.0, 20.0}) {
    const double cusp = std::asin(1.0 / a);
    boost::math::quadrature::tanh_sinh<double> quadrature;
    const auto integrand = [a](double t) {
      return std::sqrt(std::abs(1.0 + a * std::sin(t))) * std::sin(t);
    };
    // Half a turn, from the lowest to the highest sine, is half of the integral.
    const double integral = 2.0 * (quadrature.integrate(integrand, -0.5 * kPi, -cusp) +
                                   quadrature.integrate(integrand, -cusp, 0.5 * kPi));
    EXPECT_NEAR(value(a), 2.0 * integral / (kPi * a), 1e-6) << a;
  }
}

TEST(Flame, OffsetMovesTheCurve) {
  const Flame<double> centred{FlameShape::kTanh, -0.7e-4, 0.5, 0.0};
  const Flame<double> moved{FlameShape::kTanh, -0.7e-4, 0.5, -1500.0};
  EXPECT_DOUBLE_EQ(FlameResponse(moved, 500.0), FlameResponse(centred, 2000.0));
  EXPECT_LT(std::abs(FlameSlope(moved, 0.0)), 0.7e-4);
}

}  // namespace
}  // namespace howl::flame_test
