// Gaps in records whose lost samples are known: how far what is filled in is from these.
#include "estimation/analysis/instruments/fill_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/estimation/analysis/resonant_record.h"

namespace howl::fill_gaps_test {
namespace {

constexpr double kRateHz = 5000.0;
constexpr double kCycleHz = ResonantRecord::kCycleHz;
constexpr std::size_t kSamples = 12000;
constexpr double kNoise = ResonantRecord::kNoise;

Record Loop(std::uint64_t seed, double rate_hz = kRateHz, std::size_t samples = kSamples) {
  return MakeResonantRecord(seed, rate_hz, samples);
}

// Twenty samples, a gap every hundred on average, where chance will have it; none near the ends.
std::vector<Gap> Gaps(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Gap> out;
  for (std::size_t t = 700; t + 300 < kSamples; ++t) {
    if (random() % 80 != 0) continue;
    out.push_back({t, 20});
    t += 25;
  }
  return out;
}

void Lose(const std::vector<Gap>& gaps, std::vector<double>* x) {
  for (const Gap& gap : gaps) {
    for (std::size_t i = 0; i < gap.length; ++i) (*x)[gap.first + i] = (*x)[gap.first - 1];
  }
}

struct Error {
  double mean = 0.0;
  double rms = 0.0;
  double count = 0.0;
};

Error ErrorIn(const std::vector<Gap>& gaps, const std::vector<double>& filled,
              const std::vector<double>& truth) {
  Error out;
  for (const Gap& gap : gaps) {
    for (std::size_t t = gap.first; t < gap.first + gap.length; ++t) {
      out.mean += filled[t] - truth[t];
      out.rms += (filled[t] - truth[t]) * (filled[t] - truth[t]);
      ++out.count;
    }
  }
  out.mean /= out.count;
  out.rms = std::sqrt(out.rms / out.count);
  return out;
}

// What is left is the noise of the sensor at the lost samples, which nothing tells; of the mean
// square h's own error adds one part in n / 560.
TEST(FillGaps, QTellsPButForItsSensorsNoise) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Record truth = Loop(seed);
    const std::vector<Gap> gaps = Gaps(seed);
    Record lost = truth;
    Lose(gaps, &lost.pressure);
    EXPECT_GT(ErrorIn(gaps, lost.pressure, truth.pressure).rms, 20.0 * kNoise);
    const Record filled = WithGapsFilled(lost, gaps, {}, kCycleHz);
    ASSERT_EQ(filled.pressure.size(), kSamples);
    EXPECT_EQ(filled.heat_release, truth.heat_release);
    const Error error = ErrorIn(gaps, filled.pressure, truth.pressure);
    EXPECT_NEAR(error.rms, kNoise, 0.1 * kNoise);
    EXPECT_NEAR(error.mean, 0.0, 3.0 * kNoise / std::sqrt(error.count));
  }
}

TEST(FillGaps, SamplesThatAreThereStayAsTheyAre) {
  const Record truth = Loop(4);
  const std::vector<Gap> gaps = Gaps(4);
  Record lost = truth;
  Lose(gaps, &lost.pressure);
  const Record filled = WithGapsFilled(lost, gaps, {}, kCycleHz);
  std::size_t same = 0;
  for (std::size_t t = 0; t < kSamples; ++t) same += filled.pressure[t] == truth.pressure[t];
  EXPECT_EQ(same, kSamples - 20 * gaps.size());
}

// p that q says nothing of, x_t = a x_(t-1) + u_t: of one lost sample what stands beside it leaves
// an error of the variance 1 / (1 + a^2).
TEST(FillGaps, WhatStandsBesideTellsTheRest) {
  constexpr double kMemory = 0.9;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Record truth{.sampling_hz = kRateHz, .pressure = {}, .heat_release = {}};
  double x = 0.0;
  for (std::size_t t = 0; t < 40000; ++t) {
    x = kMemory * x + normal(random);
    truth.pressure.push_back(x);
    truth.heat_release.push_back(normal(random));
  }
  std::vector<Gap> gaps;
  for (std::size_t t = 1000; t < 39000; t += 20) gaps.push_back({t, 1});
  Record lost = truth;
  Lose(gaps, &lost.pressure);
  const Record filled = WithGapsFilled(lost, gaps, {}, kCycleHz);
  const double expected = 1.0 / std::sqrt(1.0 + kMemory * kMemory);
  const Error error = ErrorIn(gaps, filled.pressure, truth.pressure);
  EXPECT_NEAR(error.rms, expected, 0.06 * expected);
}

// A recorder that stops loses both at once.
TEST(FillGaps, WhereBothAreLostTheCycleGoesOn) {
  const Record truth = Loop(6);
  const std::vector<Gap> gaps = Gaps(6);
  Record lost = truth;
  Lose(gaps, &lost.pressure);
  Lose(gaps, &lost.heat_release);
  const Record filled = WithGapsFilled(lost, gaps, gaps, kCycleHz);
  const double as_lost = ErrorIn(gaps, lost.pressure, truth.pressure).rms;
  EXPECT_LT(ErrorIn(gaps, filled.pressure, truth.pressure).rms, 0.2 * as_lost);
  const double q_lost = ErrorIn(gaps, lost.heat_release, truth.heat_release).rms;
  // Of q 0.3 are noise that nothing tells.
  EXPECT_LT(ErrorIn(gaps, filled.heat_release, truth.heat_release).rms, 0.4);
  EXPECT_GT(q_lost, 0.9);
}

// Of 300 samples a period no more than four periods are taken back: the rest is told by what stands
// beside the gaps, and the time does not grow with the rate's cube.
TEST(FillGaps, AnOversampledRecordIsFilledAsWell) {
  const Record truth = Loop(9, 60000.0, 30000);
  std::vector<Gap> gaps;
  for (std::size_t t = 3000; t + 3000 < truth.pressure.size(); t += 2357) gaps.push_back({t, 240});
  Record lost = truth;
  Lose(gaps, &lost.pressure);
  const Record filled = WithGapsFilled(lost, gaps, {}, kCycleHz);
  const double as_lost = ErrorIn(gaps, lost.pressure, truth.pressure).rms;
  EXPECT_LT(ErrorIn(gaps, filled.pressure, truth.pressure).rms, 0.1 * as_lost);
}

TEST(FillGaps, ARecordIsCutAtGapsNearItsEnds) {
  const Record truth = Loop(7);
  Record lost = truth;
  const std::vector<Gap> gaps = {{5, 20}, {300, 30}, {kSamples - 40, 20}};
  Lose(gaps, &lost.pressure);
  const Record filled = WithGapsFilled(lost, gaps, {}, kCycleHz);
  ASSERT_EQ(filled.pressure.size(), kSamples - 40 - 330);
  EXPECT_EQ(filled.heat_release.size(), filled.pressure.size());
  for (std::size_t t = 0; t < filled.pressure.size(); ++t) {
    EXPECT_EQ(filled.pressure[t], truth.pressure[t + 330]) << t;
  }
}

TEST(FillGaps, WithoutGapsNothingChanges) {
  const Record truth = Loop(8);
  const Record same = WithGapsFilled(truth, {}, {}, kCycleHz);
  EXPECT_EQ(same.pressure, truth.pressure);
  EXPECT_EQ(same.heat_release, truth.heat_release);
}

}  // namespace
}  // namespace howl::fill_gaps_test
