// Whether delays follow the operating parameter, on drawn delays whose law is known.
#include "diagnosis/loop_budget/account/delay_trend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace howl::delay_trend_test {
namespace {

// Points evenly spread over the operating parameter; the delays change by `rel_span` over it and
// scatter, and each is told to within `error`.
std::vector<TimedPoint> Drawn(std::size_t count, double rel_span, double scatter, double error,
                              std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double half = 0.5 * static_cast<double>(count - 1);
  const double deviation = std::sqrt((static_cast<double>(count * count) - 1.0) / 12.0);
  std::vector<TimedPoint> out;
  for (std::size_t e = 0; e < count; ++e) {
    const double place = static_cast<double>(e) - half;
    const double law = rel_span * place / static_cast<double>(count - 1);
    out.push_back({place / deviation,
                   std::log(3e-3) + law + scatter * normal(random) + error * normal(random),
                   error * error});
  }
  return out;
}

constexpr double kNamed = 6.6;  // nats, of some forty items

TEST(DelayTrend, IsFoundWhereThereIsOne) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const DelayTrend trend = TrendOf(Drawn(6, 0.05, 0.0, 1e-3, seed));
    EXPECT_GT(trend.nats, kNamed);
    EXPECT_GE(trend.points_better, 5u);
    EXPECT_NEAR(trend.rel_span, 0.05, 0.008);
  }
}

TEST(DelayTrend, HasAnIntervalThatHoldsTheTruth) {
  int held = 0;
  double sum = 0.0;
  constexpr int kRigs = 300;
  for (int seed = 1; seed <= kRigs; ++seed) {
    const DelayTrend trend = TrendOf(Drawn(6, -0.08, 3e-3, 1e-3, static_cast<std::uint64_t>(seed)));
    held += trend.low <= -0.08 && -0.08 <= trend.high ? 1 : 0;
    sum += trend.rel_span;
  }
  EXPECT_GT(held, 0.91 * kRigs);
  EXPECT_NEAR(sum / kRigs, -0.08, 1e-3);
}

// A value that all points share is off, and all delays with it.
TEST(DelayTrend, IsNotFoundWhereAllDelaysErrTogether) {
  std::vector<TimedPoint> points = Drawn(6, 0.02, 0.0, 1e-3, 3);
  EXPECT_GT(TrendOf(points).nats, kNamed);
  for (TimedPoint& each : points) each.shared = {0.01 * each.z};
  EXPECT_LT(TrendOf(points).nats, 1.0);
}

// Equal delays, delays that scatter, and too few of whatever kind.
TEST(DelayTrend, IsNotFoundWhereThereIsNone) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const std::size_t points : {4u, 6u, 12u}) {
      for (const double scatter : {0.0, 0.003, 0.03}) {
        named += TrendOf(Drawn(points, 0.0, scatter, 1e-3, seed)).nats > kNamed ? 1 : 0;
      }
    }
    EXPECT_EQ(TrendOf(Drawn(3, 0.2, 0.0, 1e-4, seed)).nats, 0.0);
  }
  // One in twenty of all items together, of which this is one.
  EXPECT_LE(named, 2);  // of 900
}

}  // namespace
}  // namespace howl::delay_trend_test
