#include "estimation/analysis/spectra/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "estimation/analysis/spectra/spectrum.h"

namespace howl::statistics_test {
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

// A frequency that wanders as a random walk has no mean; what an interval can say is where the mean
// of the next stretch lies. Taken for white noise of the frequency, whose slow part is no larger
// than its fast one, two neighbouring stretches agreed in half of the cases. A stationary
// frequency's intervals hold as they are, and no more than a fifth of their width is the price.
TEST(FitTrend, NeighbouringStretchesOfAWanderingFrequencyAgree) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 400, kHop = 20, kSteps = 47;
  for (const bool wanders : {true, false}) {
    int agree = 0;
    double ratio = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      double phase = 0.0, frequency = 0.0;
      TrendFit fits[2];
      for (TrendFit& fit : fits) {
        std::vector<double> x(static_cast<std::size_t>(kHop * (kSteps + 2)));
        for (double& value : x) {
          frequency = wanders ? frequency + normal(random) / kHop : normal(random);
          phase += frequency / std::sqrt(kHop);
          value = phase + 0.01 * normal(random);
        }
        const Blocks blocks = Demodulate(x, 1.0, 0.0, 2 * kHop);
        std::vector<double> series;
        for (const auto& z : blocks.amplitude) series.push_back(0.5 * z.real());
        fit = FitTrend(series);
      }
      const double std = std::hypot(fits[0].slope.std, fits[1].slope.std);
      agree += std::abs(fits[0].slope.value - fits[1].slope.value) <= kNormal95 * std ? 1 : 0;
      ratio += std / std::sqrt(2.0 / kSteps) / kTrials;
    }
    EXPECT_GT(agree, 0.91 * kTrials) << "wanders " << wanders;
    if (!wanders) {
      EXPECT_LT(ratio, 1.2 * StudentInflation(CosineCount(kSteps)));
    }
  }
}

}  // namespace
}  // namespace howl::statistics_test
