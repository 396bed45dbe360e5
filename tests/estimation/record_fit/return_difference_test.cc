// What the Jacobian leaves in the band, against the sum of ln |D| over the band itself.
#include "estimation/record_fit/loop/return_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "estimation/record_fit/loop/beside_band.h"
#include "estimation/record_fit/loop/loop_tail.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::return_difference_test {
namespace {

using C = std::complex<double>;

class Jacobian : public testing::Test {
 protected:
  Jacobian() {
    const ModalLoop loop = DuctOfModes(2);
    const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
    record_ =
        MakeRecordSpectra(SimulateModalLoop(loop, 2.0, 1), cycle_hz, FlameInput::kPressureRate);
    point_.modes = {{0.97, 0.08, 0.2, 0.03}, {2.3, 0.06, 0.03, -0.01}};
    point_.path.tau = 4.2;
    point_.flame = Eigen::VectorXd::Zero(record_.flame.cols());
    // So that the loop is positive near the cycle, with a gain of one.
    const double gain = std::abs(OpenLoop(record_, point_, {0.0, 1.0}));
    unit_ = -1.0 / (gain * record_.slopes[0]);
  }

  void SetGain(double gain) { point_.flame[0] = gain * unit_; }
  C D(C s) const { return 1.0 - record_.slopes.dot(point_.flame) * OpenLoop(record_, point_, s); }

  double InBand() const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < record_.bins(); ++i) {
      sum += 2.0 * record_.share[i] * std::log(std::abs(D(record_.s[i])));
    }
    return sum;
  }

  double Magnitude() const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < record_.bins(); ++i) {
      sum += 2.0 * record_.share[i] * std::abs(std::log(std::abs(D(record_.s[i]))));
    }
    return sum;
  }

  // Of the root near the cycle, by Newton's method.
  C Root() const {
    C s(0.0, 1.0);
    for (int i = 0; i < 100; ++i) {
      const double h = 1e-6;
      s -= 0.5 * D(s) * (2.0 * h) / (D(s + h) - D(s - h));
    }
    return s;
  }

  RecordSpectra record_;
  LoopPoint point_;
  double unit_ = 0.0;
};

// By which the loop would not turn by half over the band.
TEST_F(Jacobian, KnowsNoDelayThatTheBandDoesNotTell) {
  SetGain(0.1);
  point_.path.tau = 1.001 * LeastDelay(record_);
  EXPECT_TRUE(std::isfinite(LogDeterminant(record_, point_)));
  EXPECT_NEAR(point_.path.tau, 0.5, 0.02);
  point_.path.tau *= 0.99;
  EXPECT_EQ(LogDeterminant(record_, point_), -std::numeric_limits<double>::infinity());
}

TEST_F(Jacobian, OfALoopThatDecaysIsTheSumOverTheBand) {
  for (const double tau : {0.6, 1.5, 4.2}) {
    point_.path.tau = tau;
    for (const double gain : {0.1, 0.3, 0.8}) {
      SetGain(gain);
      const double magnitude = Magnitude();
      EXPECT_GT(magnitude, 10.0);
      // Beyond an octave above the band |U| falls further by the square of 2.3 / 12.8.
      EXPECT_NEAR(LogDeterminant(record_, point_), InBand(), 0.04 * magnitude)
          << gain << " " << tau;
    }
  }
}

// A spread that let the flame answer before it is driven would be worth nats here.
TEST_F(Jacobian, OfALoopWithSpreadDelaysIsTheSumOverTheBand) {
  for (const DelaySpread spread : {DelaySpread::kNormal, DelaySpread::kGamma}) {
    for (const double rho : {0.2, 0.5, 0.9}) {
      point_.path = {spread, 1.5, rho};
      for (const double gain : {0.1, 0.5}) {
        SetGain(gain);
        const double magnitude = Magnitude();
        EXPECT_GT(magnitude, 5.0);
        EXPECT_NEAR(LogDeterminant(record_, point_), InBand(), 0.04 * magnitude)
            << gain << " " << rho << " " << static_cast<int>(spread);
      }
    }
  }
}

TEST_F(Jacobian, OfALoopWithTwoPathsIsTheSumOverTheBand) {
  for (const double share : {-0.5, 0.4}) {
    for (const double lambda : {0.7, 3.0}) {
      point_.path = {DelaySpread::kNormal, 1.5, 0.3, SecondPath{share, lambda}};
      SetGain(0.4);
      const double magnitude = Magnitude();
      EXPECT_GT(magnitude, 5.0);
      EXPECT_NEAR(LogDeterminant(record_, point_), InBand(), 0.04 * magnitude)
          << share << " " << lambda;
    }
  }
}

// Above the band, with a gain that lets the return difference vanish there, wherever between the
// points of the sum: against the integral of its logarithm by a thousand times as many.
TEST_F(Jacobian, IsTheIntegralWhereTheReturnDifferenceVanishesAboveTheBand) {
  constexpr int kSteps = 160000;
  point_.path.tau = 0.6;
  const double highest = record_.s[record_.bins() - 1].imag();
  const double bins = 2.0 * record_.share[0] * record_.scale.cycle_hz / record_.bin_hz;
  const auto integral = [&](double from, double to) {
    const double step = (to - from) / kSteps;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      sum += step * std::log(std::abs(D({0.0, from + (i + 0.5) * step})));
    }
    return sum;
  };
  for (int shift = 0; shift < 8; ++shift) {
    point_.modes[1] = {1.5 * highest * (1.0 + 0.002 * shift), 0.03, 1.0, 0.0};
    point_.flame[0] = 1.0;
    const auto u = [&](int i) { return 1.0 - D({0.0, highest * (1.0 + i / 1e5)}); };
    double most = 0.0;
    for (int i = 0; i < 100000; ++i) {
      if (u(i).imag() * u(i + 1).imag() < 0.0) most = std::max(most, u(i).real());
    }
    ASSERT_GT(most, 0.0);
    point_.flame[0] = 1.0 / most;
    const LoopTail tail(record_, point_);
    const double expected = bins * (tail.Value().real() - integral(0.0, record_.s[0].imag()) -
                                    integral(highest, 2.0 * highest));
    EXPECT_NEAR(BesideBand(record_, point_, tail), expected, 0.5) << shift;
  }
}

// A growing pair of roots adds 2 pi times its growth rates to Bode's integral: over the bins of a
// record twice its growth rate times the record's length.
TEST_F(Jacobian, DoesNotRewardALoopThatGrows) {
  SetGain(1.3);
  const C root = Root();
  ASSERT_GT(root.real(), 0.01);
  const double radians = 2.0 * std::numbers::pi * record_.scale.cycle_hz / record_.bin_hz;
  const double reward = 2.0 * record_.share[0] * root.real() * radians;
  EXPECT_GT(reward, 10.0);
  EXPECT_NEAR(InBand() - LogDeterminant(record_, point_), reward, 0.05 * reward);
}

// A flame whose answer at the cycle's lines is far from its curve's, by errors that reach over the
// band, earns what its residuals' loop earns, and not what the curve alone would.
TEST_F(Jacobian, IsThatOfTheLinesErrors) {
  point_.path.tau = 0.6;
  SetGain(0.8);
  const double of_curve = LogDeterminant(record_, point_);
  point_.flame_lines = Eigen::Vector3cd(8.0, 8.0, 8.0);
  double of_residuals = 0.0;
  for (Eigen::Index i = 0; i < record_.bins(); ++i) {
    const C s = record_.s[i];
    C factor = 1.0;
    for (int h = 1; h <= 3; ++h) {
      const C e = point_.flame_lines[h - 1];
      factor += 2.0 * kLineReach * (s * e.real() - h * e.imag()) /
                (s * s + 2.0 * kLineReach * s + static_cast<double>(h * h));
    }
    of_residuals += 2.0 * record_.share[i] * std::log(std::abs(1.0 - factor * (1.0 - D(s))));
  }
  ASSERT_LT(of_residuals, of_curve - 50.0);
  // The smooth minimum is at most the smaller one and ln 2, which it reaches to rounding.
  EXPECT_LT(LogDeterminant(record_, point_), of_residuals + std::numbers::ln2 + 1e-9);
}

}  // namespace
}  // namespace howl::return_difference_test
