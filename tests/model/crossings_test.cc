// Crossings, margins and sensitivities against brute force and differences.
#include "model/loop/crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "model/loop/poles.h"
#include "model/loop/sensitivity.h"
#include "model/noise/random_stream.h"
#include "tests/model/paper_loop.h"

namespace howl::crossings_test {
namespace {

LoopParameters<double> RandomLoop(std::uint64_t index) {
  RandomStream random(DeriveSeed(7, index));
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * random.Uniform(); };
  // Down to a damping of 0.2 %: phases then turn within a fraction of a hertz.
  const double xi = 0.002 * std::pow(150.0, random.Uniform());
  const double n = 6000.0;
  return {{between(100.0, 400.0), xi, n, index % 5 == 0 ? 0.0 : n * between(0.01, 2.0),
           between(1.3, 4.0)},
          between(0.0005, 0.008)};
}

TEST(Crossings, NoneIsMissed) {
  // Sign changes of Im L with Re L < 0 on a grid of 0.002 Hz.
  for (std::uint64_t i = 0; i < 40; ++i) {
    const LoopParameters<double> loop = RandomLoop(i);
    std::vector<double> expected;
    Complex<double> before = LoopResponse(loop, 1e-3);
    for (double f = 3e-3; f <= 1500.0; f += 2e-3) {
      const Complex<double> now = LoopResponse(loop, f);
      if (now.im * before.im < 0.0 && now.re < 0.0 && before.re < 0.0) {
        expected.push_back(f - 2e-3 * now.im / (now.im - before.im));
      }
      before = now;
    }
    const auto crossings = PhaseCrossings(loop, -1e-4, 1500.0);
    ASSERT_EQ(crossings.size(), expected.size()) << "loop " << i;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(crossings[k].frequency_hz, expected[k], 1e-3);
      EXPECT_NEAR(LoopPhaseError(loop, crossings[k].frequency_hz), 0.0, 1e-10);
      EXPECT_NEAR(crossings[k].gain_margin_db, -20.0 * std::log10(crossings[k].gain), 1e-12);
    }
  }
}

TEST(Crossings, GainCrossingsAreComplete) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    const LoopParameters<double> loop = RandomLoop(i);
    constexpr double kSlope = -0.9e-4;
    std::vector<double> expected;
    double before = LoopGain(loop, 5e-3, kSlope) - 1.0;
    for (double f = 1e-2; f <= 1500.0; f += 5e-3) {
      const double now = LoopGain(loop, f, kSlope) - 1.0;
      if (now * before < 0.0) expected.push_back(f - 5e-3 * now / (now - before));
      before = now;
    }
    const auto crossings = GainCrossings(loop, kSlope, 1500.0);
    ASSERT_EQ(crossings.size(), expected.size()) << "loop " << i;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(crossings[k].frequency_hz, expected[k], 1e-2);
      EXPECT_NEAR(LoopGain(loop, crossings[k].frequency_hz, kSlope), 1.0, 1e-9);
      // The delay margin brings the phase to 180 degrees.
      LoopParameters<double> later = loop;
      later.tau_s += crossings[k].delay_margin_s;
      EXPECT_NEAR(LoopPhaseError(later, crossings[k].frequency_hz), 0.0, 1e-9);
    }
  }
}

TEST(Crossings, MarginsAreWhereStabilityChanges) {
  const ClosedLoop model = PaperLoop(0.415);
  const double slope = 0.8 * model.flame.slope;  // stable
  const LoopMargins margins = Margins(model.loop, slope, 2000.0);
  ASSERT_TRUE(margins.stable);
  const double factor = std::pow(10.0, margins.gain_margin_db / 20.0);
  EXPECT_LT(RightmostPole(model.loop, slope * factor * 0.9999)->growth_rate, 0.0);
  EXPECT_GT(RightmostPole(model.loop, slope * factor * 1.0001)->growth_rate, 0.0);
  // Slightly less gain than unstable: the delay that destabilises.
  const double near = 0.999 * factor * slope;
  const LoopMargins close = Margins(model.loop, near, 2000.0);
  ASSERT_TRUE(std::isfinite(close.delay_margin_s));
  LoopParameters<double> loop = model.loop;
  loop.tau_s += 0.999 * close.delay_margin_s;
  EXPECT_LT(RightmostPole(loop, near)->growth_rate, 0.0);
  loop.tau_s += 0.002 * close.delay_margin_s;
  EXPECT_GT(RightmostPole(loop, near)->growth_rate, 0.0);
}

TEST(Crossings, NyquistCurveIsSmoothAndEndsWhereAsked) {
  const ClosedLoop model = PaperLoop(0.415);
  const auto curve = NyquistCurve(model.loop, model.flame.slope, 1000.0);
  EXPECT_EQ(curve.back().frequency_hz, 1000.0);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    EXPECT_LT(std::abs(std::arg(curve[i].response / curve[i - 1].response)), 2.001 * kRadPerDeg);
  }
  EXPECT_LT(curve.size(), 3000u);
}

TEST(Sensitivity, AgreesWithDifferences) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const LoopParameters<double> loop = RandomLoop(i);
    const double f = 180.0 + 37.0 * static_cast<double>(i);
    const LoopSensitivity s = LoopSensitivityAt(loop, f);
    const auto check = [&](auto&& member, const Sensitivity& expected, double scale) {
      LoopParameters<double> up = loop;
      LoopParameters<double> down = loop;
      const double h = 1e-5 * scale;
      member(up) += h;
      member(down) -= h;
      const Complex<double> u = LoopResponse(up, f);
      const Complex<double> d = LoopResponse(down, f);
      const double phase = kDegPerRad * Angle(u / d) / (2.0 * h);
      const double gain = std::log(Magnitude(u) / Magnitude(d)) / (2.0 * h);
      EXPECT_NEAR(expected.phase_deg * scale, phase * scale,
                  1e-4 * (1.0 + std::abs(phase * scale)));
      EXPECT_NEAR(expected.log_gain * scale, gain * scale, 1e-4 * (1.0 + std::abs(gain * scale)));
    };
    const Acoustics<double>& a = loop.acoustics;
    check([](auto& l) -> double& { return l.acoustics.omega_hz; }, s[LoopParameter::kOmega],
          0.01 * a.omega_hz);
    check([](auto& l) -> double& { return l.acoustics.xi; }, s[LoopParameter::kXi], a.xi);
    check([](auto& l) -> double& { return l.acoustics.N; }, s[LoopParameter::kN], a.N);
    check([](auto& l) -> double& { return l.acoustics.M; }, s[LoopParameter::kM], a.N);
    check([](auto& l) -> double& { return l.acoustics.harmonic_ratio; },
          s[LoopParameter::kHarmonicRatio], 0.01 * a.harmonic_ratio);
    check([](auto& l) -> double& { return l.tau_s; }, s[LoopParameter::kTau], loop.tau_s);
  }
}

}  // namespace
}  // namespace howl::crossings_test
