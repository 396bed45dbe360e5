#include "diagnosis/samples/fluctuation_kind.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/noise/random_stream.h"

namespace howl::fluctuation_kind_test {
namespace {

constexpr int kExperiments = 4;
constexpr int kValues = 60;
constexpr double kNoise = 0.02;

// g = h(A) f + noise, with an amplitude that follows the fluctuation f slowly, as a cycle's does,
// and a curve h that has bent to take part of it away.
template <typename Fluctuation>
std::vector<GainSeries> Draw(std::uint64_t seed, Fluctuation&& next) {
  RandomStream random(seed);
  std::vector<GainSeries> out(kExperiments);
  for (GainSeries& series : out) {
    double amplitude = 1.0;
    for (int i = 0; i < kValues; ++i) {
      const double f = next(random);
      amplitude += 0.3 * (f - amplitude);
      series.amplitude.push_back(amplitude);
      const double bent = 1.0 - 0.4 * (amplitude - 0.9);
      const double variance = std::pow(kNoise / amplitude, 2);
      series.gain.push_back(bent * f + std::sqrt(variance) * random.Normal());
      series.variance.push_back(variance);
    }
  }
  return out;
}

std::vector<GainSeries> Jumps(std::uint64_t seed, double drop, double leave) {
  bool low = false;
  return Draw(seed, [=](RandomStream& random) mutable {
    if (random.Uniform() < leave) low = !low;
    return low ? 1.0 - drop : 1.0;
  });
}

std::vector<GainSeries> Gaussian(std::uint64_t seed, double std, double correlation) {
  double x = 0.0;
  return Draw(seed, [=](RandomStream& random) mutable {
    x = correlation * x + std * std::sqrt(1.0 - correlation * correlation) * random.Normal();
    return 1.0 + x;
  });
}

TEST(FluctuationKind, JumpsAreLikelierAsJumpsAndTheDropIsFound) {
  double mean_drop = 0.0;
  double mean_leave = 0.0;
  constexpr int kDraws = 20;
  for (int i = 0; i < kDraws; ++i) {
    const auto series = Jumps(100 + static_cast<std::uint64_t>(i), 0.3, 0.15);
    const SwitchingFluctuation jumps = FitSwitching(series);
    EXPECT_LT(jumps.cost, FitColoured(series).cost - 10.0) << i;
    mean_drop += jumps.drop / kDraws;
    mean_leave += jumps.leave_low_per_step / kDraws;
  }
  EXPECT_NEAR(mean_drop, 0.3, 0.01);
  EXPECT_NEAR(mean_leave, 0.15, 0.03);
}

TEST(FluctuationKind, AGaussianProcessIsLikelierAsOne) {
  for (const double correlation : {0.2, 0.6, 0.9}) {
    for (int i = 0; i < 10; ++i) {
      const auto series = Gaussian(200 + static_cast<std::uint64_t>(i), 0.1, correlation);
      EXPECT_LT(FitColoured(series).cost, FitSwitching(series).cost) << correlation << " " << i;
    }
  }
}

// Where h is flat, the maximum of the likelihood is that of a stationary process in noise, whose
// mean over many draws is the truth.
TEST(FluctuationKind, TheProcessOfFirstOrderIsUnbiased) {
  double mean_std = 0.0;
  double mean_correlation = 0.0;
  constexpr int kDraws = 30;
  for (int i = 0; i < kDraws; ++i) {
    auto series = Gaussian(300 + static_cast<std::uint64_t>(i), 0.1, 0.5);
    RandomStream random(static_cast<std::uint64_t>(i));
    double x = 0.0;
    for (GainSeries& one : series) {
      for (int k = 0; k < kValues; ++k) {
        const auto at = static_cast<std::size_t>(k);
        x = 0.5 * x + 0.1 * std::sqrt(0.75) * random.Normal();
        one.amplitude[at] = 1.0 + 0.1 * random.Normal();
        one.variance[at] = kNoise * kNoise;
        one.gain[at] = 1.0 + x + kNoise * random.Normal();
      }
    }
    const ColouredFluctuation found = FitColoured(series);
    mean_std += found.std / kDraws;
    mean_correlation += found.step_correlation / kDraws;
  }
  EXPECT_NEAR(mean_std, 0.1, 0.004);
  EXPECT_NEAR(mean_correlation, 0.5, 0.03);
}

}  // namespace
}  // namespace howl::fluctuation_kind_test
