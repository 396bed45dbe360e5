// Saturation before noise, told from cycles that are merely regular.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "diagnosis/samples/sample_limits.h"

namespace howl::noisy_rails_test {
namespace {

constexpr Eigen::Index kSamples = 16000;

// A cycle with a share of its third harmonic in phase: above zero it is flat where it turns.
Eigen::VectorXd Cycle(double third) {
  Eigen::VectorXd out(kSamples);
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double turn = 0.2617 * static_cast<double>(i);
    out[i] = std::sin(turn) + third * std::sin(3.0 * turn);
  }
  return out;
}

Eigen::VectorXd Noise(double deviation) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, deviation);
  Eigen::VectorXd out(kSamples);
  for (double& each : out) each = normal(random);
  return out;
}

Eigen::VectorXd Clipped(const Eigen::VectorXd& x, double level) {
  return x.cwiseMin(level).cwiseMax(-level);
}

TEST(NoisyRails, AreSeenUnderNoiseThatIsNarrowerThanWhatIsCutOff) {
  for (const double level : {0.9, 0.8, 0.7, 0.5}) {  // of the cycle's amplitude
    for (const double noise : {1e-5, 1e-3, 3e-3}) {
      const Eigen::VectorXd before = Cycle(0.0) + Noise(0.05);
      const double held = (before.array().abs() > level).cast<double>().mean();
      EXPECT_NEAR(ShareOnNoisyRails(Clipped(before, level) + Noise(noise)), held, 0.1 * held)
          << level << " " << noise;
    }
  }
}

TEST(NoisyRails, AreNoneOfCyclesAndOfNoise) {
  for (const double third : {-0.3, -0.1, 0.0, 0.05}) {
    for (const double noise : {0.0, 1e-3, 1e-2, 0.1}) {
      EXPECT_EQ(ShareOnNoisyRails(Cycle(third) + Noise(noise)), 0.0) << third << " " << noise;
    }
  }
  EXPECT_EQ(ShareOnNoisyRails(Noise(1.0)), 0.0);
}

// One end alone may be the signal's own, as of what is squared.
TEST(NoisyRails, AreAtBothEnds) {
  const Eigen::VectorXd one = Cycle(0.0).cwiseMin(0.7) + Noise(1e-3);
  EXPECT_EQ(ShareOnNoisyRails(one), 0.0);
}

}  // namespace
}  // namespace howl::noisy_rails_test
