// Poles and Floquet multipliers against loops with known ones.
#include "model/poles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "model/floquet.h"
#include "tests/model/seed_loop.h"

namespace howl {
namespace {

using Complex64 = std::complex<double>;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

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
    ClosedLoop model = SeedLoop(rig.m_over_n);
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

TEST(Poles, NeutralChainTendsToItsLine) {
  const ClosedLoop model = SeedLoop(0.415);
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

TEST(Floquet, OfALinearFlameAreTheExponentialsOfThePoles) {
  ClosedLoop model = SeedLoop(0.415);
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
}  // namespace howl
