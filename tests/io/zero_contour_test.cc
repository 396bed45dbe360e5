#include "io/report/zero_contour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace howl::zero_contour_test {
namespace {

std::vector<double> Grid(double from, double to, int steps) {
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k) values.push_back(from + (to - from) * k / steps);
  return values;
}

TEST(ZeroContour, ACircleIsFoundWithItsLength) {
  const std::vector<double> x = Grid(-2.0, 2.0, 80), y = Grid(-1.5, 1.5, 70);
  std::vector<double> value;
  for (const double b : y) {
    for (const double a : x) value.push_back(a * a + b * b - 1.0);
  }
  double length = 0.0;
  for (const auto& [p, q] : ZeroContour(x, y, value)) {
    EXPECT_NEAR(std::hypot(p[0], p[1]), 1.0, 1e-3);
    EXPECT_NEAR(std::hypot(q[0], q[1]), 1.0, 1e-3);
    length += std::hypot(p[0] - q[0], p[1] - q[1]);
  }
  EXPECT_NEAR(length, 2.0 * M_PI, 0.01);
}

TEST(ZeroContour, WhatIsNotKnownHasNoLineAndASaddleHasTwo) {
  const std::vector<double> unit = {0.0, 1.0};
  EXPECT_TRUE(ZeroContour(unit, unit, {1.0, -1.0, std::nan(""), -1.0}).empty());
  EXPECT_TRUE(ZeroContour(unit, unit, {1.0, 2.0, 3.0, 4.0}).empty());
  // Two positive corners opposite to each other, joined through a positive middle: the negative
  // ones are cut off, each beside its own corner.
  const auto segments = ZeroContour(unit, unit, {3.0, -1.0, -1.0, 3.0});
  ASSERT_EQ(segments.size(), 2u);
  for (const auto& [p, q] : segments) {
    const double to_first = std::hypot(p[0] - 1.0, p[1]) + std::hypot(q[0] - 1.0, q[1]);
    const double to_second = std::hypot(p[0], p[1] - 1.0) + std::hypot(q[0], q[1] - 1.0);
    EXPECT_NEAR(std::min(to_first, to_second), 0.5, 1e-12);
  }
  // Through a negative middle the positive ones are.
  for (const auto& [p, q] : ZeroContour(unit, unit, {1.0, -3.0, -3.0, 1.0})) {
    const double to_first = std::hypot(p[0], p[1]) + std::hypot(q[0], q[1]);
    const double to_last = std::hypot(p[0] - 1.0, p[1] - 1.0) + std::hypot(q[0] - 1.0, q[1] - 1.0);
    EXPECT_NEAR(std::min(to_first, to_last), 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace howl::zero_contour_test
