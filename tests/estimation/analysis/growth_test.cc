#include "estimation/analysis/cycle/growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace howl::growth_test {
namespace {

// dA/dt = sigma A (1 - A^2) out of noise: exponential growth at sigma, then saturation at one.
// sigma is zero for the first two seconds.
std::vector<double> Ramp(double sigma, double frequency_hz, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> p;
  std::complex<double> a = 0.0;
  constexpr double kStep = 1e-4;
  for (int t = 0; t < 50000; ++t) {
    const double rate = t < 20000 ? -2.0 : sigma * (1.0 - std::norm(a));
    a += kStep * rate * a + std::sqrt(kStep) * 1e-3 * std::complex(normal(random), normal(random));
    const double time = t * kStep;
    p.push_back((a * std::polar(1.0, 2 * M_PI * frequency_hz * time)).real() +
                1e-3 * normal(random));
  }
  return p;
}

TEST(EstimateGrowth, CoversTheRateOfANoisyTransient) {
  int covered = 0, available = 0;
  double mean = 0.0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Growth growth =
        EstimateGrowth(Ramp(6.0, 166.6, static_cast<std::uint64_t>(trial)), 1e4, 165.0);
    if (!growth.available) continue;
    ++available;
    covered += std::abs(growth.rate_per_s.value - 6.0) < kNormal95 * growth.rate_per_s.std ? 1 : 0;
    mean += growth.rate_per_s.value;
    EXPECT_NEAR(growth.frequency_hz.value, 166.6, 0.5);
  }
  ASSERT_EQ(available, kTrials);
  // Saturation has taken 25 % of the rate at the window's end, half of the highest envelope.
  EXPECT_NEAR(mean / available, 6.0, 0.4);
  EXPECT_GE(covered, 0.8 * kTrials);
}

TEST(EstimateGrowth, SteadyNoiseHasNone) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> p(50000);
  for (double& value : p) value = normal(random);
  EXPECT_FALSE(EstimateGrowth(p, 1e4, 166.0).available);
}

}  // namespace
}  // namespace howl::growth_test
