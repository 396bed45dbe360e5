#include "estimation/analysis/cycle/characteristics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/estimation/analysis/coverage_rows.h"

namespace howl::characteristics_test {
namespace {

Characteristics Analysed(const Record& record, const CharacteristicsOptions& options = {}) {
  return EstimateCharacteristics(record,
                                 WelchSpectrum(RemoveMean(record.pressure),
                                               RemoveMean(record.heat_release), record.sampling_hz),
                                 options);
}

TEST(EstimateCharacteristics, NoiseHasNoLimitCycle) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Record record{5000.0, {}, {}};
  for (int t = 0; t < 16000; ++t) {
    record.pressure.push_back(normal(random));
    record.heat_release.push_back(normal(random));
  }
  EXPECT_EQ(Analysed(record).state, CycleState::kNoLimitCycle);
}

// A linear resonance in noise has a Rayleigh envelope: the variance of A^2 is its squared mean.
TEST(EstimateCharacteristics, NoisyResonanceIsNoLimitCycle) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  Record record{5000.0, {}, {}};
  const double r = std::exp(-M_PI * 6.0 / 5000.0);
  const double a1 = 2 * r * std::cos(2 * M_PI * 200.0 / 5000.0), a2 = -r * r;
  double y1 = 0, y2 = 0;
  for (int t = 0; t < 250000; ++t) {
    const double y = a1 * y1 + a2 * y2 + normal(random);
    y2 = y1;
    y1 = y;
    record.pressure.push_back(y);
  }
  // Short segments see the resonance, 6 Hz wide, as one peak.
  const Characteristics c =
      EstimateCharacteristics(record, WelchSpectrum(record.pressure, {}, 5000.0, 2048));
  EXPECT_EQ(c.state, CycleState::kNoLimitCycle);
  EXPECT_NEAR(c.power_fluctuation.value, 1.0, 0.35);
  EXPECT_TRUE(std::isnan(c.phase_deg.value));
}

TEST(EstimateCharacteristics, BurstsAreIntermittent) {
  fixtures::SyntheticOptions options;
  options.breathing = 0.35;
  options.breathing_time_s = 0.2;
  options.samples = 50000;
  const Characteristics c = Analysed(fixtures::Synthesise(options, 3).record);
  EXPECT_EQ(c.state, CycleState::kIntermittent);
  EXPECT_FALSE(c.stationary);
}

TEST(EstimateCharacteristics, DriftIsFoundAndMeasured) {
  Record record{5000.0, {}, {}};
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int t = 0; t < 16000; ++t) {
    const double time = t / 5000.0;
    const double phase = 2 * M_PI * (205.0 * time + 0.5 * 2.0 * time * time);
    const double amplitude = 1.0 + 0.1 * (time - 1.6);
    record.pressure.push_back(amplitude * std::cos(phase) + 0.05 * normal(random));
    record.heat_release.push_back(amplitude * std::cos(phase + 0.5) + 0.05 * normal(random));
  }
  const Characteristics c = Analysed(record);
  EXPECT_EQ(c.state, CycleState::kLimitCycle);
  EXPECT_NEAR(c.frequency_drift_hz_per_s.value, 2.0, 0.05);
  EXPECT_NEAR(c.amplitude_drift_per_s.value, 0.1, 0.01);
  EXPECT_FALSE(c.stationary);
}

TEST(EstimateCharacteristics, PapersMethodAsPublished) {
  fixtures::SyntheticOptions options;
  options.noise = 0.02;
  const fixtures::SyntheticRecord truth = fixtures::Synthesise(options, 5);
  const Characteristics c = Analysed(truth.record, {.method = CharacteristicsMethod::kPaper});
  EXPECT_NEAR(c.frequency_hz.value, 210.0, 5000.0 / 16000.0);  // on a bin
  EXPECT_NEAR(std::remainder(c.frequency_hz.value, 5000.0 / 16000.0), 0.0, 1e-9);
  EXPECT_NEAR(c.phase_deg.value, -10.0, 0.5);
  EXPECT_NEAR(c.gain.value, 13.0, 0.13);
  EXPECT_TRUE(std::isnan(c.phase_deg.std));
}

// Coverage over kinds of records; bench/coverage_study prints the table for many more of them. With
// 10 rows of 24 the share of a true 95 % has a standard error of 1.4 %.
TEST(LongCoverage, IntervalsHoldTheTruthAndThePapersMethodIsWorse) {
  std::array<fixtures::Tally, fixtures::kQuantities> all;
  std::uint64_t seed = 77;
  for (const fixtures::CoverageRow& row : fixtures::CoverageRows()) {
    const fixtures::RowResult result = fixtures::RunCoverageRow(row, 24, seed += 1000);
    EXPECT_EQ(result.cycles_missed, 0) << row.name;
    EXPECT_EQ(result.lines_missed, 0) << row.name;
    EXPECT_LT(result.tally[fixtures::kPhase].Rms(), result.paper_phase_rms_deg) << row.name;
    for (std::size_t k = 0; k < fixtures::kQuantities; ++k) {
      all[k].count += result.tally[k].count;
      all[k].covered += result.tally[k].covered;
    }
  }
  for (std::size_t k = 0; k < fixtures::kQuantities; ++k) {
    EXPECT_GE(all[k].Coverage(), 0.91) << fixtures::kQuantityNames[k];
  }
}

}  // namespace
}  // namespace howl::characteristics_test
