// Poles and Floquet multipliers against loops with known ones.
#include "model/loop/poles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "model/cycles/floquet.h"
#include "model/numerics/constants.h"
#include "tests/model/paper_loop.h"

namespace howl::poles_test {
namespace {

using Complex64 = std::complex<double>;

// 1 = k lambda^2 (N / D_1 + M / D_2) e^(-lambda tau): two real equations, linear in N and M.
LoopParameters<double> LoopWithPole(Complex64 lambda, double tau_s, double slope) {
  const double w = kTwoPi * 215.0;
  const auto d = [&](double w0) { return lambda * lambda + 0.4 * w0 * lambda + w0 * w0; };
  const Complex64 common = slope * lambda * lambda * std::exp(-lambda * tau_s);
  const Complex64 a = common / d(w);
  const Complex64 b = common / d(3.0 * w);
  const double determinant = a.real() * b.imag() - b.real() * a.imag();
  return {{215.0, 0.2, b.imag() / determinant, -a.imag() / determinant, 3.0}, tau_s};
}

TEST(Poles, FindsAPoleThatTheLoopWasMadeFor) {
  constexpr double kSlope = -0.7e-4;
  for (const Complex64 lambda : {Complex64(22.0, kTwoPi * 216.0), Complex64(-20.0, kTwoPi * 216.5),
                                 Complex64(0.0, kTwoPi * 216.2)}) {
    const auto loop = LoopWithPole(lambda, 0.00346123, kSlope);
    const PoleSet set = ClosedLoopPoles(loop, kSlope);
    EXPECT_TRUE(set.complete);
    const bool found = std::any_of(set.poles.begin(), set.poles.end(), [&](const Pole& p) {
      return std::abs(p.growth_rate - lambda.real()) < 1e-8 &&
             std::abs(p.frequency_hz - lambda.imag() / kTwoPi) < 1e-9;
    });
    EXPECT_TRUE(found) << lambda;
  }
}

TEST(Poles, CountIsCompleteAtHighGainLowDampingAndLongDelay) {
  struct Rig {
    double xi, m_over_n, tau_s, gain;
  };
  for (const Rig& rig :
       {Rig{0.02, 0.1, 0.003, 0.3}, Rig{0.2, 1.0, 0.02, 1.0}, Rig{0.3, 0.0, 0.001, 2.0},
        Rig{0.9, 0.4, 0.0035, 3.0}, Rig{0.05, 2.0, 0.008, 0.8}}) {
    ClosedLoop model = PaperLoop(rig.m_over_n);
    model.loop.acoustics.xi = rig.xi;
    model.loop.tau_s = rig.tau_s;
    const PoleSet set = ClosedLoopPoles(model.loop, rig.gain * model.flame.slope, {-0.3, 7.0});
    EXPECT_TRUE(set.complete) << rig.xi << ": " << set.poles.size() << " of " << set.counted;
    for (const Pole& p : set.poles) {
      const Complex64 s(p.growth_rate, kTwoPi * p.frequency_hz);
      EXPECT_LT(std::abs(rig.gain * model.flame.slope * LoopTransfer(model.loop, s).value - 1.0),
                1e-8);
    }
  }
}

// The second mode's own poles, at -0.06 of w here, are none of a loop without that mode.
TEST(Poles, OfOneModeAreCountedWithoutASecond) {
  for (const double xi : {1e-5, 0.02, 0.045}) {
    ClosedLoop model = PaperLoop(0.0);
    model.loop.acoustics.N *= xi / model.loop.acoustics.xi;
    model.loop.acoustics.xi = xi;
    const PoleSet set = ClosedLoopPoles(model.loop, model.flame.slope);
    EXPECT_TRUE(set.complete) << xi << ": " << set.poles.size() << " of " << set.counted;
  }
}

TEST(Poles, NeutralChainTendsToItsLine) {
  const ClosedLoop model = PaperLoop(0.415);
  const double line = std::log(-model.flame.slope * 1.415 * 6609.0) / model.loop.tau_s;
  const PoleSet set = ClosedLoopPoles(model.loop, model.flame.slope, {-0.15, 8000.0 / 215.0});
  ASSERT_TRUE(set.complete);
  // Off it by a share that falls as the square of the frequency: s G = N + M + O(1 / s), whose
  // first-order term is in phase with the frequency.
  const auto off = [&](double below_hz) {
    Pole highest;
    for (const Pole& p : set.poles) {
      if (p.frequency_hz < below_hz && p.frequency_hz > highest.frequency_hz) highest = p;
    }
    return (highest.growth_rate - line) * highest.frequency_hz * highest.frequency_hz;
  };
  EXPECT_NEAR(off(8000.0) / off(4000.0), 1.0, 0.02);
}

// The search never ended, or found nothing, where the loop hardly feels its flame.
TEST(Poles, OfAVanishingSlopeAreTheModes) {
  for (const double m_over_n : {0.0, 0.4}) {
    for (const double slope : {0.0, -1e-30, -1e-9}) {
      const ClosedLoop model = PaperLoop(m_over_n);
      const auto pole = RightmostPole(model.loop, slope);
      ASSERT_TRUE(pole.has_value()) << slope;
      // Of s^2 + 2 xi w s + w^2, xi = 0.2 at 215 Hz; the slope moves it by k N = 7e-6 of w.
      EXPECT_NEAR(pole->growth_rate, -0.2 * kTwoPi * 215.0, 1e-4 * kTwoPi * 215.0) << slope;
      EXPECT_NEAR(pole->frequency_hz, 215.0 * std::sqrt(1.0 - 0.04), 0.02) << slope;
    }
    ClosedLoop slow = PaperLoop(m_over_n);
    slow.loop.acoustics.xi = 1.25;  // roots at -w / 2 and -2 w
    const auto pole = RightmostPole(slow.loop, 0.0);
    ASSERT_TRUE(pole.has_value());
    EXPECT_NEAR(pole->growth_rate, -0.5 * kTwoPi * 215.0, 1e-9);
    EXPECT_EQ(pole->frequency_hz, 0.0);
  }
}

// As k grows the poles tend to those of k (N + M) e^(-tau s) = 1, s = (ln|k (N + M)| + j pi n) /
// tau; off it by 2 xi w / (tau s) and the like.
TEST(Poles, OfALargeSlopeAreTheDelays) {
  for (const double slope : {-1.0, -1e10, -1e26}) {
    const ClosedLoop model = PaperLoop(0.4);
    const auto pole = RightmostPole(model.loop, slope);
    ASSERT_TRUE(pole.has_value()) << slope;
    const double growth = std::log(-slope * 6609.0 * 1.4) / model.loop.tau_s;
    EXPECT_NEAR(pole->growth_rate / growth, 1.0, 0.1) << slope;
  }
}

TEST(Floquet, OfALinearFlameAreTheExponentialsOfThePoles) {
  ClosedLoop model = PaperLoop(0.415);
  model.flame.shape = FlameShape::kLinear;
  LimitCycle any;  // the slope is the same everywhere, so that every orbit will do
  any.frequency_hz = 216.0;
  any.rate = {0.0, 1.0};
  FloquetOptions options;
  options.tolerance = HUGE_VAL;  // there is no multiplier of one here
  options.min_steps = 256;
  const FloquetMultipliers floquet = CycleStability(model, any, options);
  const PoleSet set = ClosedLoopPoles(model.loop, model.flame.slope, {-0.1, 6.5});
  ASSERT_GE(set.poles.size(), 3u);
  for (const Pole& pole : set.poles) {
    const Complex64 expected =
        std::exp(Complex64(pole.growth_rate, kTwoPi * pole.frequency_hz) / any.frequency_hz);
    double nearest = HUGE_VAL;
    for (const Complex64& m : floquet.multipliers) {
      nearest =
          std::min(nearest, std::min(std::abs(m - expected), std::abs(std::conj(m) - expected)));
    }
    EXPECT_LT(nearest, 1e-6) << pole.frequency_hz;
  }
}

}  // namespace
}  // namespace howl::poles_test
