// The onset from gains and frequencies that lie on lines which are known.
#include "estimation/joint_records/onset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace howl::onset_test {
namespace {

// Gain one at 0.6, at 212 Hz; points on one side of it only.
std::vector<OnsetPoint> Points(std::mt19937_64& random, double gain_std, double frequency_std) {
  std::normal_distribution<double> normal;
  std::vector<OnsetPoint> points;
  for (const double x : {0.42, 0.46, 0.50, 0.54}) {
    SmallSignalLoop loop;
    loop.loop_gain = {0.7 + 5.0 / 3.0 * (x - 0.42) + gain_std * normal(random), gain_std};
    loop.frequency_hz = {200.0 + 200.0 / 3.0 * (x - 0.42) + frequency_std * normal(random),
                         frequency_std};
    loop.found = true;
    points.push_back({x, loop});
  }
  return points;
}

TEST(Onset, IntervalsBeyondThePointsHold) {
  std::mt19937_64 random(5);
  constexpr int kTrials = 2000;
  int places = 0;
  int frequencies = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Onset onset = OnsetOf(Points(random, 0.01, 0.5));
    places += onset.at.lo < 0.6 && 0.6 < onset.at.hi ? 1 : 0;
    frequencies +=
        std::abs(onset.frequency_hz.value - 212.0) < kNormal95 * onset.frequency_hz.std ? 1 : 0;
  }
  // In e^-1 of the trials four points scatter by more than their errors, and Student's t of two
  // degrees of freedom, 4.3, makes those intervals hold nearly always: 0.95 (1 - e^-1) + e^-1 is
  // 0.968. The frequency's has both lines' errors.
  EXPECT_GT(places, 0.95 * kTrials);
  EXPECT_LT(places, 0.985 * kTrials);
  EXPECT_GT(frequencies, 0.95 * kTrials);
  EXPECT_LT(frequencies, kTrials);
}

TEST(Onset, GainsThatDoNotChangeTellNothing) {
  std::mt19937_64 random(6);
  std::vector<OnsetPoint> points = Points(random, 0.05, 0.5);
  for (OnsetPoint& point : points) point.loop.loop_gain.value = 0.8;
  const Onset onset = OnsetOf(points);
  EXPECT_TRUE(onset.at.available);
  EXPECT_TRUE(std::isinf(onset.at.hi));
  EXPECT_TRUE(std::isnan(onset.frequency_hz.value));
}

TEST(Onset, PointsWithoutARootAreLeftOut) {
  std::mt19937_64 random(7);
  std::vector<OnsetPoint> points = Points(random, 0.01, 0.5);
  points[0].loop = {};
  EXPECT_TRUE(OnsetOf(points).at.available);
  points[1].loop = {};
  EXPECT_FALSE(OnsetOf(points).at.available);
}

}  // namespace
}  // namespace howl::onset_test
