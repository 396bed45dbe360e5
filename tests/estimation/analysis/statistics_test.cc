#include "estimation/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "estimation/spectrum.h"

namespace howl {
namespace {

TEST(StudentInflation, MatchesTables) {
  EXPECT_NEAR(StudentInflation(10) * kNormal95, 2.228, 5e-4);
  EXPECT_NEAR(StudentInflation(1e7), 1.0, 1e-6);
}

// A first-order autoregression: an interval that took its values for independent would hold the
// mean in about 60 % of the cases.
TEST(ErrorOfMean, CoversUnderSerialCorrelation) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  int covered = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> x;
    double value = normal(random) / std::sqrt(1.0 - 0.25);
    double mean = 0.0;
    for (int t = 0; t < 200; ++t) {
      value = 0.5 * value + normal(random);
      x.push_back(value);
      mean += value / 200;
    }
    const MeanError error = ErrorOfMean(x, 0.0);
    const double std =
        std::sqrt(error.covariance(0, 0)) * StudentInflation(error.degrees_of_freedom);
    covered += std::abs(mean) < kNormal95 * std ? 1 : 0;
  }
  EXPECT_GT(covered, 0.92 * kTrials);
  EXPECT_LT(covered, 0.97 * kTrials);
}

// The slope of a walk of unit variance a step, averaged as half-overlapping Hann blocks do, has the
// standard error 1 / sqrt(n); that of white noise sqrt(12 / n^3): the same fit has to find both.
TEST(FitTrend, CoversWalkAndWhiteNoise) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 300, kHop = 20, kSteps = 47;
  for (bool walk : {true, false}) {
    int covered = 0;
    double mean_std = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<double> x(static_cast<std::size_t>(kHop * (kSteps + 2)));
      double sum = 0.0;
      for (double& value : x) {
        sum += normal(random) / std::sqrt(kHop);
        value = walk ? sum : normal(random);
      }
      const Blocks blocks = Demodulate(x, 1.0, 0.0, 2 * kHop);
      std::vector<double> series;
      for (const auto& z : blocks.amplitude) series.push_back(0.5 * z.real());
      const TrendFit fit = FitTrend(series);
      covered += std::abs(fit.slope.value) < kNormal95 * fit.slope.std ? 1 : 0;
      mean_std += fit.slope.std / kTrials;
    }
    EXPECT_GT(covered, 0.91 * kTrials) << "walk " << walk;
    // White noise of variance one, averaged by Hann over 2 hops: 1.5 / (2 hops).
    const double expected = walk ? 1.0 / std::sqrt(kSteps)
                                 : std::sqrt(12.0 * 1.5 / (2 * kHop) / std::pow(kSteps, 3) * 4 / 3);
    EXPECT_GT(mean_std, 0.8 * expected) << "walk " << walk;
    EXPECT_LT(mean_std, 1.8 * expected) << "walk " << walk;
  }
}

}  // namespace
}  // namespace howl
