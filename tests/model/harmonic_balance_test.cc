#include "model/cycles/harmonic_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "model/cycles/floquet.h"
#include "model/cycles/prediction.h"
#include "model/loop/crossings.h"
#include "model/numerics/constants.h"
#include "tests/model/paper_loop.h"

namespace howl::harmonic_balance_test {
namespace {

using Complex64 = std::complex<double>;

// The loop's two halves, each from its own header: V_k = L_k Q_k by the response at real
// frequencies, Q_k by quadrature of Phi(v(t)) on a grid of its own.
TEST(HarmonicBalance, SolutionSatisfiesTheLoop) {
  for (const FlameShape shape : {FlameShape::kTanh, FlameShape::kArctan, FlameShape::kAlgebraic}) {
    ClosedLoop model = PaperLoop(0.415);
    model.flame.shape = shape;
    model.flame.offset = 1200.0;  // even harmonics too
    model.flame.slope *= 1.3;
    const auto cycles = LimitCycles(model, 600.0);
    ASSERT_EQ(cycles.size(), 1u);
    const LimitCycle& cycle = cycles[0];
    EXPECT_GT(std::abs(cycle.rate[2]), 1e-4 * cycle.rate_amplitude());
    constexpr int kSamples = 1000;
    for (int k = 0; k <= 5; ++k) {
      Complex64 q = 0.0;
      for (int i = 0; i < kSamples; ++i) {
        const double theta = kTwoPi * i / kSamples;
        const double value = FlameResponse(model.flame, EvaluateHarmonics(cycle.rate, theta));
        q += value * std::polar((k == 0 ? 1.0 : 2.0) / kSamples, -k * theta);
      }
      const auto at = static_cast<std::size_t>(k);
      EXPECT_LT(std::abs(q - cycle.heat_release[at]), 1e-9 * cycle.heat_release_amplitude());
      if (k == 0) continue;
      const Complex<double> l = LoopResponse(model.loop, k * cycle.frequency_hz);
      const Complex<double> g = AcousticResponse(model.loop.acoustics, k * cycle.frequency_hz);
      EXPECT_LT(std::abs(Complex64(l.re, l.im) * q - cycle.rate[at]),
                1e-8 * cycle.rate_amplitude());
      EXPECT_LT(std::abs(Complex64(g.re, g.im) * q - cycle.pressure[at]),
                1e-8 * cycle.pressure_amplitude());
    }
    EXPECT_LE(cycle.tail, 1e-10);
  }
}

TEST(HarmonicBalance, SmallCycleIsTheDescribingFunctions) {
  // Just above the threshold, with a cubic flame, D(A) = k (1 - a^2 / 9): to first order in the
  // excess of gain, a^2 = 9 (1 - 1 / gain) and the frequency is the crossing's.
  ClosedLoop model = PaperLoop(0.1);
  model.flame.shape = FlameShape::kCubic;
  const double gain = PhaseCrossings(model.loop, model.flame.slope, 300.0).front().gain;
  constexpr double kExcess = 1e-4;
  model.flame.slope *= (1.0 + kExcess) / gain;
  const auto cycles = LimitCycles(model, 300.0);
  ASSERT_EQ(cycles.size(), 1u);
  const double a = cycles[0].rate_amplitude() * -model.flame.slope / model.flame.saturation;
  EXPECT_NEAR(a * a, 9.0 * kExcess, 0.01 * 9.0 * kExcess);
  const double crossing_hz =
      PhaseCrossings(model.loop, model.flame.slope, 300.0).front().frequency_hz;
  EXPECT_NEAR(cycles[0].frequency_hz, crossing_hz, 1e-4);
}

TEST(HarmonicBalance, NoCycleBelowTheThreshold) {
  ClosedLoop model = PaperLoop(0.415);
  model.flame.slope *= 0.8;
  EXPECT_TRUE(LimitCycles(model, 2000.0).empty());
  EXPECT_FALSE(SolveLimitCycle(model, 216.0, 5000.0).has_value());
}

TEST(HarmonicBalance, ClippedFlameConvergesSlowlyButDoes) {
  ClosedLoop model = PaperLoop(0.2);
  model.flame.shape = FlameShape::kPiecewiseLinear;
  HarmonicBalanceOptions options;
  options.tolerance = 1e-4;
  const auto cycles = LimitCycles(model, 300.0, options);
  ASSERT_EQ(cycles.size(), 1u);
  EXPECT_NEAR(cycles[0].frequency_hz, 216.1, 0.5);
}

TEST(Prediction, GathersWhatTheLoopWillDo) {
  // Between 0.625 and 0.923 two cycles attract; at 0.415 one; with less gain none, and rest does.
  EXPECT_EQ(PredictLoop(PaperLoop(0.75), 4.2).attracting_cycles(), 2);
  const LoopPrediction one = PredictLoop(PaperLoop(0.415), 4.2);
  EXPECT_EQ(one.attracting_cycles(), 1);
  EXPECT_FALSE(one.rest_is_stable());
  EXPECT_FALSE(one.margins.stable);
  ClosedLoop weak = PaperLoop(0.415);
  weak.flame.slope *= 0.8;
  const LoopPrediction none = PredictLoop(weak, 4.2);
  EXPECT_TRUE(none.cycles.empty());
  EXPECT_TRUE(none.rest_is_stable());
  EXPECT_TRUE(none.margins.stable);
  EXPECT_TRUE(none.poles.complete);
}

TEST(Floquet, SmallCycleRelaxesAtTwiceItsExcessGrowth) {
  // Near the threshold the amplitude obeys da/dt = sigma a (1 - a^2 / a_0^2), which relaxes at
  // -2 sigma, sigma being the growth rate from rest.
  ClosedLoop model = PaperLoop(0.1);
  const double gain = PhaseCrossings(model.loop, model.flame.slope, 300.0).front().gain;
  model.flame.slope *= 1.003 / gain;
  const auto cycles = LimitCycles(model, 300.0);
  ASSERT_EQ(cycles.size(), 1u);
  const FloquetMultipliers floquet = CycleStability(model, cycles[0]);
  EXPECT_TRUE(floquet.stable);
  // sigma = ln(gain) / (real part of d ln L / d s at the crossing) to first order.
  const Complex64 s(0.0, kTwoPi * cycles[0].frequency_hz);
  const ModeTransfer l = LoopTransfer(model.loop, s);
  const double sigma = (-std::log(1.003) / (l.derivative / l.value)).real();
  EXPECT_NEAR(floquet.LeadingGrowthRate(cycles[0].frequency_hz), -2.0 * sigma, 0.03 * sigma);
}

}  // namespace
}  // namespace howl::harmonic_balance_test
