// What a record says of samples that were lost: the power of their errors, and the intervals of a
// fit to what was drawn in their place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "estimation/analysis/instruments/draw_clipped.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::lost_pressure_test {
namespace {

// White errors of variance one; the taper's difference of neighbouring bins doubles their power.
TEST(LostPressure, IsThatOfTheDrawsOverTheSignals) {
  constexpr double kError = 0.03;
  const ModalLoop loop = DuctOfModes(2);
  Record record = SimulateModalLoop(loop, 2.0, 1);
  EXPECT_EQ(MakeRecordSpectra(record, 203.0, FlameInput::kPressure).lost_pressure.size(), 0);
  RandomStream random(2);
  record.pressure_errors.resize(16);
  for (std::vector<double>& draw : record.pressure_errors) {
    for (std::size_t t = 0; t < record.pressure.size(); ++t) {
      draw.push_back(kError * random.Normal());
    }
  }
  const RecordSpectra spectra = MakeRecordSpectra(record, 203.0, FlameInput::kPressure);
  ASSERT_EQ(spectra.lost_pressure.size(), spectra.bins());
  const double expected = 2.0 * std::pow(kError / spectra.scale.pressure, 2);
  EXPECT_NEAR(spectra.lost_pressure.mean(), expected, 0.03 * expected);
  ASSERT_TRUE(spectra.middle);
  EXPECT_NEAR(spectra.middle->lost_pressure.mean(), expected, 0.1 * expected);
}

Record ClippedAndDrawn(const ModalLoop& loop, const Record& truth, double of_largest) {
  RangeEnds ends;
  ends.upper = of_largest * *std::ranges::max_element(truth.pressure);
  ends.lower = -ends.upper;
  Record recorded = truth;
  for (double& value : recorded.pressure) value = std::clamp(value, ends.lower, ends.upper);
  return WithClippedDrawn(recorded, ends, CycleFrequency(loop, 150.0, 300.0), 1);
}

// Of a sine beyond 0.7 of its amplitude half of the samples are lost. Were what is drawn in their
// place counted as recorded, 87 % of the intervals would contain the truth; q, which is known all
// the time, tells something there, so that they may be a little too wide.
TEST(LongLostPressure, IntervalsOfAClippedRecordCoverAndAreNotBiased) {
  constexpr int kRecords = 30;
  const ModalLoop loop = DuctOfModes(2);
  std::map<std::string, double> bias;
  int inside = 0;
  int all = 0;
  for (int i = 0; i < kRecords; ++i) {
    const Record truth = SimulateModalLoop(loop, 4.0, 300 + static_cast<std::uint64_t>(i));
    const IdentifiedLoop found = Identify(loop, ClippedAndDrawn(loop, truth, 0.7), 8);
    for (const IdentifiedParameter& p : found.parameters) {
      bias[p.name] += p.Z() / kRecords;
      ++all;
      if (std::abs(p.Z()) < 1.96) ++inside;
    }
  }
  EXPECT_GE(inside, static_cast<int>(0.93 * all)) << inside << " of " << all;
  EXPECT_LE(inside, static_cast<int>(0.99 * all)) << inside << " of " << all;
  for (const auto& [name, z] : bias) EXPECT_LT(std::abs(z), 0.6) << name;
}

}  // namespace
}  // namespace howl::lost_pressure_test
