// Which samples of p count as clipped, and whose are drawn anew.
#include "estimation/health/clipped_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "estimation/health/sample_health.h"
#include "tests/estimation/analysis/resonant_record.h"

namespace howl::clipped_samples_test {
namespace {

constexpr std::size_t kSamples = 8000;

LoopRecord Recorded() {
  return {"one", 1.0, ResonantRecord::kCycleHz, MakeResonantRecord(1, 5000.0, kSamples)};
}

// Beyond this share of the largest value; returns the end.
double Clip(double of_largest, std::vector<double>* x) {
  const double end = of_largest * *std::ranges::max_element(*x);
  for (double& value : *x) value = std::clamp(value, -end, end);
  return end;
}

double ShareBeyond(double end, const std::vector<double>& x) {
  return static_cast<double>(
             std::ranges::count_if(x, [&](double value) { return std::abs(value) >= end; })) /
         static_cast<double>(x.size());
}

TEST(ClippedSamples, StandAtTheEndsOfTheRange) {
  LoopRecord at = Recorded();
  EXPECT_EQ(ShareClipped(at.record.pressure), 0.0);
  const std::vector<double> before = at.record.pressure;
  const double end = Clip(0.7, &at.record.pressure);
  EXPECT_EQ(RepeatedEnds(at.record.pressure).upper, end);
  EXPECT_EQ(RepeatedEnds(at.record.pressure).lower, -end);
  EXPECT_DOUBLE_EQ(ShareClipped(at.record.pressure), ShareBeyond(end, before));
}

TEST(ClippedSamples, AtOneEndLeaveTheOther) {
  LoopRecord at = Recorded();
  const double end = 0.7 * *std::ranges::max_element(at.record.pressure);
  for (double& value : at.record.pressure) value = std::min(value, end);
  EXPECT_EQ(RepeatedEnds(at.record.pressure).upper, end);
  EXPECT_TRUE(std::isinf(RepeatedEnds(at.record.pressure).lower));
}

TEST(ClippedSamples, BehindWhichNoiseCameStay) {
  LoopRecord at = Recorded();
  const double end = Clip(0.7, &at.record.pressure);
  std::mt19937_64 random(2);
  std::normal_distribution<double> noise(0.0, 2e-3 * end);
  for (double& value : at.record.pressure) value += noise(random);
  EXPECT_EQ(ShareClipped(at.record.pressure), 0.0);
  const std::vector<LoopRecord> same = WithClippedSamplesDrawn({at}, {}, 1, 1);
  EXPECT_EQ(same[0].record.pressure, at.record.pressure);
}

TEST(ClippedSamples, AreDrawnUnlessTheyAreTooManyOrWithheld) {
  std::vector<LoopRecord> records(3, Recorded());
  Clip(0.7, &records[1].record.pressure);
  Clip(0.2, &records[2].record.pressure);
  EXPECT_GT(ShareClipped(records[2].record.pressure), kMostClipped);
  const std::vector<LoopRecord> drawn = WithClippedSamplesDrawn(records, {}, 1, 2);
  EXPECT_EQ(drawn[0].record.pressure, records[0].record.pressure);
  EXPECT_FALSE(drawn[1].record.pressure_errors.empty());
  EXPECT_EQ(ShareClipped(drawn[1].record.pressure), 0.0);
  EXPECT_EQ(drawn[2].record.pressure, records[2].record.pressure);
  const std::vector<LoopRecord> withheld = WithClippedSamplesDrawn(records, {"p_clipping"}, 1, 2);
  EXPECT_EQ(withheld[1].record.pressure, records[1].record.pressure);
  const std::vector<LoopRecord> alone = WithClippedSamplesDrawn(records, {}, 1, 1);
  EXPECT_EQ(alone[1].record.pressure, drawn[1].record.pressure);
}

}  // namespace
}  // namespace howl::clipped_samples_test
