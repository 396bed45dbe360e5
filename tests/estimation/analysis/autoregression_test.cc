// Against the closed forms of a process of the first order.
#include "estimation/analysis/instruments/autoregression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace howl::autoregression_test {
namespace {

constexpr double kMemory = 0.8;
constexpr double kVariance = 4.0;

Autoregression Process() {
  std::vector<double> autocovariance;
  for (int k = 0; k <= 5; ++k) autocovariance.push_back(kVariance * std::pow(kMemory, k));
  return Autoregression(autocovariance);
}

// Given its neighbours, e_t has the mean a (e_(t-1) + e_(t+1)) / (1 + a^2), and the others say
// nothing.
TEST(Autoregression, OfOneSampleItsNeighboursTellAll) {
  const Autoregression process = Process();
  const std::vector<double> e = {9.0, -7.0, 1.0, 100.0, 3.0, 5.0, -4.0};
  const double both = 1.0 + kMemory * kMemory;
  EXPECT_NEAR(process.GivenAllOthers(e, 3), kMemory * (1.0 + 3.0) / both, 1e-12);
  EXPECT_NEAR(process.deviation(), std::sqrt(kVariance * (1.0 - kMemory * kMemory) / both), 1e-12);
}

// The mean of products of n samples has a deviation of some c_0 sqrt(2 (1 + a^2) / (1 - a^2) / n).
TEST(Autoregression, DrawsHaveItsAutocovariance) {
  constexpr std::size_t kSamples = 200000;
  RandomStream random(3);
  const std::vector<double> e = Process().Draw(kSamples, &random);
  ASSERT_EQ(e.size(), kSamples);
  for (std::size_t k = 0; k < 8; ++k) {
    double sum = 0.0;
    for (std::size_t t = k; t < kSamples; ++t) sum += e[t] * e[t - k];
    EXPECT_NEAR(sum / static_cast<double>(kSamples - k),
                kVariance * std::pow(kMemory, static_cast<double>(k)), 0.03 * kVariance)
        << k;
  }
}

// As a process that has forgotten how it began, from the first sample on.
TEST(Autoregression, DrawsBeginAsTheyGoOn) {
  const Autoregression process = Process();
  RandomStream random(4);
  double sum = 0.0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) sum += std::pow(process.Draw(1, &random)[0], 2);
  EXPECT_NEAR(sum / kDraws, kVariance, 4.0 * kVariance * std::sqrt(2.0 / kDraws));
}

}  // namespace
}  // namespace howl::autoregression_test
