// Samples that show their converter: clipped, stuck, held, coarse, appended. What the truth is
// comes from how each signal is made.
#include "estimation/health/sample_health.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace howl::sample_health_test {
namespace {

constexpr double kRateHz = 10000.0;

// A cycle at 220 Hz whose amplitude breathes, with noise, on a grid of 0.3 mV as converters have.
std::vector<double> Signal(double grid = 3e-4) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> samples;
  double envelope = 0.0;
  for (int i = 0; i < 30000; ++i) {
    envelope += -0.002 * envelope + 0.005 * normal(random);
    const double cycle = (1.0 + envelope) * std::sin(2.0 * std::numbers::pi * 220.0 * i / kRateHz);
    samples.push_back(std::round((cycle + 0.02 * normal(random)) / grid) * grid);
  }
  return samples;
}

std::vector<std::string> Subjects(const std::vector<double>& samples) {
  std::vector<std::string> subjects;
  for (const Finding& finding : CheckSamples("exp1", "p", samples, kRateHz)) {
    EXPECT_EQ(finding.experiment, "exp1");
    EXPECT_EQ(finding.kind, FindingKind::kSamples);
    subjects.push_back(finding.subject);
  }
  return subjects;
}

TEST(SampleHealth, ASoundSignalHasNoFinding) {
  EXPECT_THAT(Subjects(Signal()), testing::IsEmpty());
  // Quantised to some hundred steps.
  EXPECT_THAT(Subjects(Signal(0.01)), testing::IsEmpty());
  // A simulated sine that is sampled in step with its period, and one that is not.
  std::vector<double> in_step;
  std::vector<double> free;
  for (int i = 0; i < 10000; ++i) {
    in_step.push_back(std::sin(2.0 * std::numbers::pi * (i % 125) / 125.0));
    free.push_back(std::sin(0.0123456 * i));
  }
  EXPECT_THAT(Subjects(free), testing::IsEmpty());
  EXPECT_THAT(Subjects(in_step), testing::ElementsAre("p_appended"));  // which it is
}

TEST(SampleHealth, StuckSamplesAreAllButTheFirstOfARun) {
  std::vector<double> samples = Signal();
  EXPECT_THAT(StuckSamples(samples), testing::IsEmpty());
  std::fill_n(samples.begin() + 1001, 39, samples[1000]);
  std::fill_n(samples.begin() + 20001, 59, samples[20000]);
  std::fill_n(samples.begin() + 25001, 2, samples[25000]);  // by chance
  const std::vector<Gap> found = StuckSamples(samples);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].first, 1001u);
  EXPECT_EQ(found[0].length, 39u);
  EXPECT_EQ(found[1].first, 20001u);
  EXPECT_EQ(found[1].length, 59u);
  // At the ends of a range a signal is clipped.
  samples = Signal();
  for (double& each : samples) each = std::min(each, 0.5);
  EXPECT_THAT(StuckSamples(samples), testing::IsEmpty());
}

// Of a slow recorder a stand of 4 ms has four samples, and those of stands are one in fifty: they
// must not be taken for what repeats by chance.
TEST(SampleHealth, ManyShortStandsAreNotByChance) {
  for (const std::size_t length : {4, 6}) {
    std::vector<double> samples = Signal(1e-6);
    samples.resize(5000);
    ASSERT_THAT(StuckSamples(samples), testing::IsEmpty());
    for (std::size_t first = 100; first + length < samples.size(); first += 50 * length) {
      std::fill_n(samples.begin() + static_cast<std::ptrdiff_t>(first), length, samples[first]);
    }
    const std::vector<Gap> found = StuckSamples(samples);
    EXPECT_EQ(found.size(), (samples.size() - 100 - length + 50 * length - 1) / (50 * length));
    for (const Gap& gap : found) EXPECT_EQ(gap.length, length - 1);
  }
}

TEST(SampleHealth, ClippedAtOneEndOrBoth) {
  std::vector<double> samples = Signal();
  for (double& each : samples) each = std::min(each, 0.9);
  EXPECT_THAT(Subjects(samples), testing::ElementsAre("p_clipped"));
  const Health health = CheckSamples("exp1", "p", samples, kRateHz);
  EXPECT_THAT(health[0].text, testing::HasSubstr("its largest value, 0.9, stands in"));
  for (double& each : samples) each = std::max(each, -0.9);
  EXPECT_THAT(Subjects(samples), testing::ElementsAre("p_clipped", "p_clipped"));
}

TEST(SampleHealth, StuckForAWhile) {
  std::vector<double> samples = Signal();
  std::fill(samples.begin() + 5000, samples.begin() + 5300, samples[5000]);
  const Health health = CheckSamples("exp1", "p", samples, kRateHz);
  ASSERT_EQ(health.size(), 1U);
  EXPECT_EQ(health[0].subject, "p_stuck");
  EXPECT_EQ(health[0].value, 300.0);
  EXPECT_THAT(health[0].text, testing::HasSubstr("for 300 samples, from 0.5 to 0.53 s"));
}

// Where a cycle dies away for a while, coarse steps stand still though nothing is lost.
TEST(SampleHealth, CoarseStepsStandStillByThemselves) {
  std::vector<double> samples = Signal(0.2);
  for (std::size_t i = 5000; i < 5300; ++i) samples[i] = 0.2 * std::round(0.1 * samples[i] / 0.2);
  EXPECT_THAT(Subjects(samples), testing::ElementsAre("p_coarse"));
  EXPECT_TRUE(StuckSamples(samples).empty());
}

TEST(SampleHealth, HeldOverSeveralSamples) {
  std::vector<double> samples = Signal(1e-6);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = samples[i - i % 4];
  const Health health = CheckSamples("exp1", "p", samples, kRateHz);
  ASSERT_EQ(health.size(), 1U);
  EXPECT_EQ(health[0].subject, "p_held");
  EXPECT_THAT(health[0].text, testing::HasSubstr("about 2.5e+03 Hz and stored at 10000 Hz"));
}

TEST(SampleHealth, CoarseAndAppended) {
  EXPECT_THAT(Subjects(Signal(0.2)), testing::Contains("p_coarse"));
  std::vector<double> samples = Signal();
  const std::vector<double> again = samples;
  samples.insert(samples.end(), again.begin(), again.end());
  const Health health = CheckSamples("exp1", "p", samples, kRateHz);
  ASSERT_EQ(health.size(), 1U);
  EXPECT_EQ(health[0].subject, "p_appended");
  EXPECT_EQ(health[0].value, 30000.0);
}

}  // namespace
}  // namespace howl::sample_health_test
