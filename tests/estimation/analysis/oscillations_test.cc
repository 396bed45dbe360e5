// Records with two oscillations at once, whose truth is their closed form
// (two_oscillation_record.h): what is found of each, and how often the 95 % intervals hold.
#include "estimation/analysis/oscillations/oscillations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/oscillations/notch.h"
#include "model/numerics/units.h"
#include "tests/estimation/analysis/coverage_rows.h"
#include "tests/estimation/analysis/two_oscillation_record.h"

namespace howl::oscillations_test {
namespace {

using fixtures::Tally;
using fixtures::TwoOscillations;

struct Row {
  std::string name;
  TwoOscillations options;
  bool picked = false;  // by cycle_hz
};

std::vector<Row> Rows() {
  return {
      {"slow rules q", {.slow_in_q = 20.0}},
      {"slow in both", {.slow_in_p = 3.0, .slow_in_q = 20.0}, true},
      {"slow modulates amplitude", {.slow_hz = 5.0, .slow_in_q = 5.0, .amplitude_modulation = 1.1}},
      {"slow modulates both, wandering",
       {.diffusion_rad2_per_s = 10.0,
        .slow_hz = 8.0,
        .slow_in_q = 5.0,
        .amplitude_modulation = 0.9,
        .phase_modulation_rad = 1.0},
       true},
      {"slow swings phase", {.slow_in_q = 5.0, .phase_modulation_rad = 2.0}, true},
      {"acoustic 1.22, equal", {.other_hz = 305.0, .other_in_p = 1.0}, true},
      {"acoustic 1.22, three times stronger", {.other_hz = 305.0, .other_in_p = 3.0}, true},
      {"acoustic 1.1, wandering",
       {.diffusion_rad2_per_s = 5.0, .other_hz = 275.0, .other_in_p = 1.0},
       true},
      {"acoustic 0.6, twice stronger", {.other_hz = 150.0, .other_in_p = 2.0}, true},
  };
}

// The range leaves the frequency unknown by a tenth.
std::optional<CycleBand> BandOf(const Row& row, double frequency_hz) {
  if (!row.picked) return std::nullopt;
  return CycleBand{0.96 * frequency_hz, 1.04 * frequency_hz};
}

struct Tallies {
  Tally frequency, phase, gain;
  int missed = 0;
};

Tallies TallyOf(const Row& row, int records, std::uint64_t seed) {
  Tallies tallies;
  for (int i = 0; i < records; ++i) {
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(i));
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    TwoOscillations o = row.options;
    o.phase_deg = uniform(-45.0, 20.0);
    o.gain = uniform(10.0, 20.0);
    const double factor = uniform(0.97, 1.03);
    o.frequency_hz *= factor;
    o.other_hz *= factor;
    const Record record = fixtures::Synthesise(o, random());
    const Analysis analysis = AnalyseRecord(record, {}, BandOf(row, o.frequency_hz));
    const Characteristics& c = analysis.characteristics;
    if (c.state != CycleState::kLimitCycle) {
      ++tallies.missed;
      continue;
    }
    tallies.frequency.Add(c.frequency_hz, o.frequency_hz);
    tallies.phase.Add({WrapDeg(c.phase_deg.value - o.phase_deg), c.phase_deg.std}, 0.0);
    tallies.gain.Add({c.gain.value / o.gain, c.gain.std / o.gain}, 1.0);
  }
  return tallies;
}

// Of `trials` intervals of 95 %, as few as this hold by chance in one case of a thousand.
int FewestCovered(int trials) {
  return static_cast<int>(std::floor(0.95 * trials - 3.1 * std::sqrt(0.95 * 0.05 * trials)));
}

TEST(TwoOscillations, ThePickedCycleIsFoundWithItsInterval) {
  constexpr int kRecords = 12;
  for (const Row& row : Rows()) {
    const Tallies tallies = TallyOf(row, kRecords, 100);
    EXPECT_EQ(tallies.missed, 0) << row.name;
    for (const Tally* tally : {&tallies.frequency, &tallies.phase, &tallies.gain}) {
      EXPECT_GE(tally->covered, FewestCovered(kRecords)) << row.name;
    }
  }
}

TEST(LongTwoOscillations, CoverageAndBias) {
  constexpr int kRecords = 200;
  for (const Row& row : Rows()) {
    const Tallies tallies = TallyOf(row, kRecords, 1000);
    std::printf("%-36s missed %3d\n", row.name.c_str(), tallies.missed);
    EXPECT_LE(tallies.missed, kRecords / 50) << row.name;
    for (const auto& [name, tally] : {std::pair{"frequency", &tallies.frequency},
                                      {"phase", &tallies.phase},
                                      {"gain", &tallies.gain}}) {
      std::printf("  %-10s coverage %.3f  bias %9.2e  rms %9.2e  mean std %9.2e\n", name,
                  tally->Coverage(), tally->Bias(), tally->Rms(), tally->MeanStd());
      EXPECT_GE(tally->covered, FewestCovered(tally->count)) << row.name << ' ' << name;
      // A bias shows as a mean error beyond its own scatter.
      EXPECT_LE(std::abs(tally->Bias()),
                0.25 * tally->MeanStd() + 3.3 * tally->Rms() / std::sqrt(tally->count))
          << row.name << ' ' << name;
    }
  }
}

const Oscillation* Near(const Analysis& analysis, double hz, double within_hz) {
  for (const Oscillation& one : analysis.oscillations) {
    if (std::abs(one.characteristics.frequency_hz.value - hz) < within_hz) return &one;
  }
  return nullptr;
}

TEST(TwoOscillations, BothAreReported) {
  const TwoOscillations o{.slow_in_p = 0.5, .slow_in_q = 4.0, .slow_diffusion_rad2_per_s = 0.05};
  const Analysis analysis = AnalyseRecord(fixtures::Synthesise(o, 5));
  ASSERT_EQ(analysis.oscillations.size(), 2U);
  const Oscillation* const slow = Near(analysis, 10.0, 0.3);
  const Oscillation* const cycle = Near(analysis, 250.0, 1.0);
  ASSERT_NE(slow, nullptr);
  ASSERT_NE(cycle, nullptr);
  EXPECT_TRUE(cycle->is_cycle);
  EXPECT_FALSE(slow->is_cycle);
  // The mean squares by closed form: of q 16 / 2 and 1 / 2, and the noise's 0.01.
  EXPECT_NEAR(slow->q_share, 8.0 / 8.51, 0.03);
  EXPECT_NEAR(cycle->p_share, 0.5 / 0.635, 0.03);
  // p = 0.5 cos(theta_s + 0.3), q = 4 / 13 cos theta_s.
  const Characteristics& c = slow->characteristics;
  EXPECT_EQ(c.state, CycleState::kLimitCycle);
  EXPECT_NEAR(c.gain.value, 0.5 * 13.0 / 4.0, kNormal95 * c.gain.std + 0.01);
  EXPECT_NEAR(c.phase_deg.value, 0.3 * kDegPerRad, kNormal95 * c.phase_deg.std + 0.5);
}

TEST(TwoOscillations, TheRangePicksEither) {
  const TwoOscillations o{.other_hz = 305.0, .other_in_p = 1.0};
  const Record record = fixtures::Synthesise(o, 6);
  const Analysis first = AnalyseRecord(record, {}, CycleBand{200.0, 280.0});
  const Analysis second = AnalyseRecord(record, {}, CycleBand{290.0, 400.0});
  EXPECT_NEAR(first.characteristics.frequency_hz.value, 250.0, 0.5);
  EXPECT_NEAR(second.characteristics.frequency_hz.value, 305.0, 0.5);
  EXPECT_NEAR(second.characteristics.gain.value, 6.0, 0.1);
  EXPECT_NEAR(second.characteristics.phase_deg.value, 40.0, 1.0);
  EXPECT_EQ(Near(first, 305.0, 1.0)->is_cycle, false);
  EXPECT_EQ(Near(second, 305.0, 1.0)->is_cycle, true);
}

// In a range without an oscillation the skirt of a stronger neighbour is highest: that is no cycle.
TEST(TwoOscillations, ASkirtIsNoCycle) {
  const TwoOscillations o{.diffusion_rad2_per_s = 10.0};
  const Record record = fixtures::Synthesise(o, 10);
  const Analysis analysis = AnalyseRecord(record, {}, CycleBand{256.0, 300.0});
  EXPECT_EQ(analysis.characteristics.state, CycleState::kNoLimitCycle);
  ASSERT_EQ(analysis.oscillations.size(), 1U);
  EXPECT_FALSE(analysis.oscillations[0].is_cycle);
  EXPECT_NEAR(analysis.oscillations[0].characteristics.frequency_hz.value, 250.0, 1.5);
}

// Sidebands of a modulation are the cycle's, no oscillations of their own.
TEST(TwoOscillations, SidebandsAreNone) {
  const TwoOscillations o{.slow_hz = 15.0, .slow_in_q = 5.0, .amplitude_modulation = 0.9};
  const Analysis analysis = AnalyseRecord(fixtures::Synthesise(o, 7));
  EXPECT_EQ(analysis.oscillations.size(), 2U);
}

// A resonance that noise excites is no cycle, whether a slow oscillation stands beside it or not:
// its squared amplitude varies by its squared mean.
TEST(TwoOscillations, ASlowOneMakesNoCycleOfAResonance) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  const double r = std::exp(-M_PI * 6.0 / 5000.0);
  const double a1 = 2 * r * std::cos(2 * M_PI * 200.0 / 5000.0), a2 = -r * r;
  double y1 = 0, y2 = 0;
  Record record{5000.0, {}, {}};
  for (int t = 0; t < 50000; ++t) {
    const double slow = std::cos(2 * M_PI * 8.0 * t / 5000.0);
    const double y = a1 * y1 + a2 * y2 + (1.0 + 0.5 * slow) * normal(random);
    y2 = y1;
    y1 = y;
    record.pressure.push_back(y);
    record.heat_release.push_back(0.1 * y + 20.0 * slow + 0.1 * normal(random));
  }
  const Analysis analysis = AnalyseRecord(record, {}, CycleBand{150.0, 250.0});
  EXPECT_EQ(analysis.characteristics.state, CycleState::kNoLimitCycle);
}

// 30 s of a cycle whose line is 5 Hz wide: as wide as the running median of the finest spectrum.
TEST(TwoOscillations, AWideLineStandsOutInALongRecord) {
  const TwoOscillations o{.duration_s = 30.0, .diffusion_rad2_per_s = 30.0, .slow_in_q = 5.0};
  const Analysis analysis = AnalyseRecord(fixtures::Synthesise(o, 9));
  const Characteristics& c = analysis.characteristics;
  EXPECT_EQ(c.state, CycleState::kLimitCycle);
  EXPECT_NEAR(c.frequency_hz.value, 250.0, kNormal95 * c.frequency_hz.std + 0.2);
  EXPECT_NEAR(c.gain.value, 13.0, 0.1);
  EXPECT_NEAR(c.phase_deg.value, -20.0, 0.4);
}

TEST(Notch, TakesOutASteadyToneAndLeavesTheCycle) {
  Record record{5000.0, {}, {}};
  for (int t = 0; t < 20000; ++t) {
    record.pressure.push_back(3.0 + std::cos(2 * M_PI * 250.0 * t / 5000.0));
  }
  std::vector<double> cycle = record.pressure;
  for (int t = 0; t < 20000; ++t) {
    record.pressure[static_cast<std::size_t>(t)] += 20.0 * std::cos(2 * M_PI * 10.0 * t / 5000.0);
  }
  const auto notch = NotchBeside(10.0, 250.0, 4.0);
  ASSERT_TRUE(notch);
  const Record rest = WithoutOscillations(record, std::vector<Notch>{*notch});
  double worst = 0.0;
  for (std::size_t t = 0; t < cycle.size(); ++t) {
    worst = std::max(worst, std::abs(rest.pressure[t] - cycle[t]));
  }
  EXPECT_LT(worst, 0.02);
  EXPECT_FALSE(NotchBeside(251.0, 250.0, 4.0));  // 24 widths of 1 / 4 s would be needed
}

}  // namespace
}  // namespace howl::oscillations_test
