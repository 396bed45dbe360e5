// The count of growing roots against polynomials, and against the phase crossings of a delayed
// loop.
#include "estimation/record_fit/growing_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

namespace howl {
namespace {

using C = std::complex<double>;

constexpr double kXi = 0.1;

// The loop slope V(s) (s + b) / (s^2 + 2 xi s + 1) e^(-tau s) in a band up to 6.4.
int Growing(FlameInput input, double slope, double tau = 0.0, double b = 0.0) {
  RecordSpectra record;
  record.flame_input = input;
  record.s = Eigen::VectorXcd::Constant(1, C(0.0, 6.4));
  record.slopes = Eigen::VectorXd::Constant(1, 1.0);
  LoopPoint point;
  point.modes = {{1.0, kXi, 1.0, b}};
  point.tau = tau;
  point.flame = Eigen::VectorXd::Constant(1, slope);
  return GrowingRoots(record, point);
}

// s^2 + (2 xi - slope) s + 1
TEST(GrowingRoots, OfAPressureDrivenFlameArePairs) {
  EXPECT_EQ(Growing(FlameInput::kPressure, 1.9 * kXi), 0);
  EXPECT_EQ(Growing(FlameInput::kPressure, 2.1 * kXi), 2);
  EXPECT_EQ(Growing(FlameInput::kPressure, -10.0), 0);
}

// (1 - slope) s^2 + 2 xi s + 1 and s^2 + 2 xi s + 1 - slope
TEST(GrowingRoots, OnTheRealAxisAreCountedOnce) {
  EXPECT_EQ(Growing(FlameInput::kPressureRate, 0.9), 0);
  EXPECT_EQ(Growing(FlameInput::kPressureRate, 1.5), 1);
  EXPECT_EQ(Growing(FlameInput::kVelocity, 0.9), 0);
  EXPECT_EQ(Growing(FlameInput::kVelocity, 1.1), 1);
}

// s^3 + 2 xi s^2 + (1 - slope) s - slope b: where the integral of p has a lasting part.
TEST(GrowingRoots, OfALoopThatIntegrates) {
  EXPECT_EQ(Growing(FlameInput::kVelocity, 0.5, 0.0, 0.1), 1);
  EXPECT_EQ(Growing(FlameInput::kVelocity, 0.5, 0.0, -0.1), 0);
  EXPECT_EQ(Growing(FlameInput::kVelocity, 0.5, 0.0, -0.3), 2);
}

// A pair comes with each crossing of the phase whose gain exceeds one.
TEST(GrowingRoots, OfADelayedLoopComeWithItsPhaseCrossings) {
  constexpr double kTau = 3.3;
  const auto open = [](double w) {
    const C s(0.0, w);
    return s * std::polar(1.0, -kTau * w) / (s * s + 2.0 * kXi * s + 1.0);
  };
  std::vector<double> gains;
  constexpr double kStep = 1e-5;
  for (double w = kStep; w < 6.3; w += kStep) {
    const C here = open(w);
    if (here.imag() > 0.0 && open(w + kStep).imag() <= 0.0 && here.real() > 0.0) {
      gains.push_back(here.real());
    }
  }
  std::ranges::sort(gains, std::greater());
  ASSERT_GE(gains.size(), 3u);
  int roots = 0;
  for (const double gain : gains) {
    EXPECT_EQ(Growing(FlameInput::kPressure, 0.99 / gain, kTau), roots);
    roots += 2;
    EXPECT_EQ(Growing(FlameInput::kPressure, 1.01 / gain, kTau), roots);
  }
}

}  // namespace
}  // namespace howl
