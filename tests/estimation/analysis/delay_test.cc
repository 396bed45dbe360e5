#include "estimation/analysis/loop/delay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "estimation/analysis/flame/flame_curve.h"
#include "estimation/analysis/loop/vanishing_phi.h"

namespace howl::delay_test {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The paper's table 2, and the delays that its equation (3) gives, in milliseconds.
const std::vector<DelayInput> kTable2 = {
    {{219.9, kUnknown}, {-5.74, kUnknown}},  {{209.1, kUnknown}, {-9.44, kUnknown}},
    {{205.7, kUnknown}, {-14.35, kUnknown}}, {{202.7, kUnknown}, {-19.18, kUnknown}},
    {{198.4, kUnknown}, {-22.92, kUnknown}}, {{179.8, kUnknown}, {-42.72, kUnknown}}};
const std::vector<double> kTauMs = {3.338, 3.461, 3.452, 3.437, 3.459, 3.511};

TEST(EstimateDelays, PublishedTableGivesThePapersBranchAndDelays) {
  const DelayChoice choice = EstimateDelays(kTable2);
  EXPECT_TRUE(choice.by_consistency);
  EXPECT_EQ(choice.branch, 0);
  ASSERT_EQ(choice.tau_s.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(1e3 * choice.tau_s[i].value, kTauMs[i], 5e-4) << i;
  }
}

// A delay of 12.5 ms shows phases that only k = 2 makes consistent.
TEST(EstimateDelays, FindsALongDelaysBranch) {
  std::vector<DelayInput> inputs;
  for (double f : {180.0, 188.0, 197.0, 205.0, 216.0}) {
    inputs.push_back({{f, 0.01}, {360.0 * f * 0.0125 - 270.0 - 720.0, 0.1}});
  }
  const DelayChoice choice = EstimateDelays(inputs);
  EXPECT_EQ(choice.branch, 2);
  for (const Estimate& tau : choice.tau_s) EXPECT_NEAR(tau.value, 0.0125, 1e-9);
  // By the phase, and by the frequency: d tau = d phase / (360 f) - tau d f / f.
  EXPECT_NEAR(choice.tau_s[0].std, std::hypot(0.1 / 360.0, 0.0125 * 0.01) / 180.0, 1e-12);
  EXPECT_EQ(EstimateDelays(inputs, 1).branch, 1);
}

TEST(EstimateDelays, KeepsThePapersBranchWhereNoneIsConsistent) {
  std::vector<DelayInput> inputs;
  const std::vector<double> phases = {50.0, 52.0, 48.0, 24.0, 5.0};
  for (std::size_t i = 0; i < phases.size(); ++i) {
    inputs.push_back({{98.0 + 6.0 * static_cast<double>(i), 0.1}, {phases[i], 0.5}});
  }
  const DelayChoice choice = EstimateDelays(inputs);
  EXPECT_FALSE(choice.by_consistency);
  EXPECT_EQ(choice.branch, 0);
}

// P(k) = S_k^-(n - 1) / sum: with one phase at all frequencies every tau_k is a multiple of 1 / f,
// all spreads are equal, and nothing can be told.
TEST(EstimateDelays, OnePhaseAtAllFrequenciesTellsNothing) {
  std::vector<DelayInput> inputs;
  for (const double f : {100.0, 101.0, 102.0}) inputs.push_back({{f, 0.0}, {20.0, 0.0}});
  const DelayChoice choice = EstimateDelays(inputs);
  double total = 0.0;
  for (const DelayBranch& branch : choice.branches) {
    EXPECT_NEAR(branch.spread, choice.branches[0].spread, 1e-12);
    EXPECT_NEAR(branch.probability, 1.0 / static_cast<double>(choice.branches.size()), 1e-6);
    total += branch.probability;
  }
  EXPECT_NEAR(total, 1.0, 1e-12);
  EXPECT_EQ(choice.branch, 0);
  EXPECT_FALSE(choice.by_consistency);
}

// Delays that differ by a few percent at frequencies that differ no more: where a branch is called
// known it is the true one at the stated rate at least.
TEST(EstimateDelays, ADecidedBranchIsTheTrueOneInNineteenOfTwentyCases) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  int decided = 0, right = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const std::size_t n = 3 + random() % 8;
    const int periods = static_cast<int>(random() % 4);
    const double shared_s = (0.3 + 0.9 * uniform(random) + periods) / 200.0;
    const double width = std::pow(10.0, -3.0 + 2.0 * uniform(random));  // 0.1 to 10 percent
    const double detuning = 0.02 + 0.08 * uniform(random);
    std::vector<DelayInput> inputs;
    std::complex<double> mean = 0.0;
    std::vector<double> turned;
    for (std::size_t i = 0; i < n; ++i) {
      const double f = 200.0 * (1.0 + detuning * normal(random));
      const double tau_s = shared_s * (1.0 + width * normal(random));
      turned.push_back(360.0 * f * tau_s - 270.0);
      inputs.push_back({{f, 0.01}, {std::remainder(turned.back(), 360.0), 0.1}});
      mean += std::polar(1.0, turned.back() * M_PI / 180.0);
    }
    const DelayChoice choice = EstimateDelays(inputs);
    if (!choice.by_consistency) continue;
    ++decided;
    // Phases are taken nearest to their mean; the branch counts from there.
    const double turns = (turned[0] - std::arg(mean) * 180.0 / M_PI) / 360.0;
    right += choice.branch == static_cast<int>(std::round(turns)) ? 1 : 0;
  }
  EXPECT_GT(decided, 1000);
  EXPECT_GE(right, 0.95 * decided);
}

// Loop gains gain * 2 pi f * |Phi'(0)| of the published tables 2 and 3, experiments 1 to 4.
TEST(EstimateVanishingPhi, PublishedGainsReachOneAt0675) {
  const auto gain = [](double g, double f, double slope) {
    return LoopGainFromSlope({g, kUnknown}, {f, kUnknown}, {slope, kUnknown});
  };
  std::vector<LoopGainPoint> points = {{0.56, gain(12.14, 219.9, -0.703e-4)},
                                       {0.53, gain(13.15, 209.1, -0.707e-4)},
                                       {0.51, gain(14.79, 205.7, -0.670e-4)},
                                       {0.49, gain(16.05, 202.7, -0.626e-4)}};
  EXPECT_NEAR(points[0].loop_gain.value, 1.179, 5e-4);
  for (LoopGainPoint& point : points) point.loop_gain.std = kUnknown;
  const VanishingPhi result = EstimateVanishingPhi(points);
  ASSERT_TRUE(result.available);
  EXPECT_NEAR(result.phi, 0.675, 5e-4);
  EXPECT_LT(result.lo, 0.675);
  EXPECT_GT(result.lo, 0.56);
  EXPECT_GT(result.hi, 0.675);
}

TEST(EstimateVanishingPhi, IntervalIsUnboundedWithoutASlope) {
  const VanishingPhi result = EstimateVanishingPhi(
      std::vector<LoopGainPoint>{{0.5, {1.20, 0.05}}, {0.52, {1.22, 0.05}}, {0.54, {1.20, 0.05}}});
  EXPECT_TRUE(std::isinf(result.hi));
  EXPECT_TRUE(std::isinf(result.lo));
}

TEST(EstimateVanishingPhi, FiellersIntervalCovers) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int covered = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<LoopGainPoint> points;
    for (double phi : {0.45, 0.47, 0.49, 0.51, 0.53, 0.56}) {
      points.push_back({phi, {2.3 - 2.0 * phi + 0.02 * normal(random), 0.02}});
    }
    const VanishingPhi result = EstimateVanishingPhi(points);
    covered += result.lo < 0.65 && 0.65 < result.hi ? 1 : 0;
  }
  EXPECT_GT(covered, 0.94 * kTrials);
  EXPECT_LT(covered, 0.98 * kTrials);  // scatter above the stated one widens it now and then
}

}  // namespace
}  // namespace howl::delay_test
