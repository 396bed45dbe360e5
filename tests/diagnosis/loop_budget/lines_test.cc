// Oscillations that are no part of the loop: hum in a sensor, and a tone in the duct.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "diagnosis/loop_budget/forms/tone.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::lines_test {
namespace {

constexpr double kShare = 0.05;  // of the signal

std::vector<LoopRecord> WithLine(std::vector<LoopRecord> records, double line_hz, bool in_p) {
  for (LoopRecord& each : records) {
    std::vector<double>& signal = in_p ? each.record.pressure : each.record.heat_release;
    const double amplitude = kShare * std::numbers::sqrt2 * RootMeanSquare(signal);
    for (std::size_t i = 0; i < signal.size(); ++i) {
      const double t = static_cast<double>(i) / each.record.sampling_hz;
      signal[i] +=
          amplitude * std::sin(2.0 * std::numbers::pi * line_hz * t + each.operating_parameter);
    }
  }
  return records;
}

std::vector<LoopRecord> DuctsWithHum(double line_hz, bool in_p) {
  return WithLine(DuctsAt({1.2, 1.5, 1.8}), line_hz, in_p);
}

void ExpectHum(const LoopDiagnosis& found, double line_hz, bool in_p, double share = kShare) {
  const Budget& budget = *found.diagnosis.budget;
  ASSERT_EQ(budget.entries.size(), 1u);
  const BudgetEntry& hum = budget.entries[0];
  EXPECT_EQ(hum.item, "mains_hum");
  EXPECT_EQ(hum.experiments_better, 3u);
  ASSERT_EQ(hum.parameters.size(), 2u);
  EXPECT_NEAR(hum.parameters[0].value, share, 0.3 * share);
  EXPECT_NEAR(hum.parameters[1].value, line_hz, 0.05);
  const auto& noise = found.best.structure.noise;
  const LoopNoise source = in_p ? LoopNoise::kPressureHum : LoopNoise::kHeatReleaseHum;
  EXPECT_EQ(std::ranges::count(noise, source, &NoiseTerm::source), 1) << in_p;
}

TEST(LongLinesOfRecords, AreHumInTheChannelThatHasIt) {
  for (const bool in_p : {false, true}) {
    ExpectHum(DiagnoseLoops(DuctsWithHum(60.0, in_p), DuctsForm(),
                            Among({"mains_hum", "background_noise", "channel_skew"})),
              60.0, in_p);
  }
}

// Of the mains' multiples one may stand out alone: a source in the duct would have driven the
// flame.
TEST(LongLinesOfRecords, AreHumAtOneMultipleAlone) {
  ExpectHum(
      DiagnoseLoops(DuctsWithHum(350.0, true), DuctsForm(), Among({"mains_hum", "external_tone"})),
      350.0, true);
}

// Of a rectifier the odd ones stand alone, and no slope goes through them and the even ones.
TEST(LinesOfRecords, AreHumOfOddMultiples) {
  std::vector<LoopRecord> records = DuctsWithHum(50.0, false);
  for (const int multiple : {3, 5, 7})
    records = WithLine(std::move(records), 50.0 * multiple, false);
  ExpectHum(DiagnoseLoops(records, DuctsForm(), Among({"mains_hum", "extra_acoustic_mode"})), 50.0,
            false, 2.0 * kShare);
}

// Wherever it lies between two bins: half way it is in both with either sign.
TEST(ToneIn, IsFoundToAFractionOfABin) {
  const LoopRecord duct = DuctAt(1.5, 0.8, 1);
  const double bin_hz = 1.0 / 0.8;
  for (const double bins : {78.0, 78.13, 78.25, 78.5, 78.62, 78.75, 79.0}) {
    LoopRecord with_tone = duct;
    std::vector<double>& p = with_tone.record.pressure;
    const double amplitude = 0.05 * RootMeanSquare(p);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double t = static_cast<double>(i) / duct.record.sampling_hz;
      p[i] += amplitude * std::cos(2.0 * std::numbers::pi * bins * bin_hz * t + 0.4);
    }
    EXPECT_NEAR(ToneIn(LoopRecords({with_tone}, 0)) / bin_hz, bins, 0.05) << bins;
  }
}

// Of a source in the duct that is no part of the loop.
TEST(LinesOfRecords, AreATone) {
  constexpr double kTone_hz = 98.13;
  std::vector<LoopRecord> rig;
  for (const double gain : {1.2, 1.5, 1.8}) {
    const double size = RootMeanSquare(DuctAt(gain, 0.8, 1).record.pressure);
    const auto with_tone = [&](ModalLoop* loop) {
      loop->tone = 0.05 * size;
      loop->tone_hz = kTone_hz;
    };
    rig.push_back(DuctAt(gain, 0.8, rig.size() + 1, {}, with_tone));
  }
  EXPECT_NEAR(ToneIn(LoopRecords(rig, 0)), kTone_hz, 0.1);
  const LoopDiagnosis found = DiagnoseLoops(
      rig, DuctsForm(), Among({"external_tone", "extra_acoustic_mode", "duct_noise"}));
  ASSERT_EQ(found.diagnosis.budget->entries.size(), 1u);
  EXPECT_EQ(found.diagnosis.budget->entries[0].item, "external_tone");
  EXPECT_NEAR(found.diagnosis.budget->entries[0].parameters[1].value, kTone_hz, 0.1);
}

}  // namespace
}  // namespace howl::lines_test
