// Lines of the mains below the band in which loops are fitted.
#include "diagnosis/samples/hum_below_band.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/loop_budget/sample_facts.h"
#include "model/noise/random_stream.h"

namespace howl::hum_below_band_test {
namespace {

constexpr double kSampling_hz = 20000.0;
constexpr double kCycle_hz = 1000.0;  // the band begins at 150 Hz

// A cycle of amplitude one whose phase wanders, with noise of which most lies at low frequencies.
std::vector<double> Cycle(std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<double> out(40000);
  double phase = 0.0;
  double slow = 0.0;
  for (double& x : out) {
    phase += 2.0 * std::numbers::pi * kCycle_hz / kSampling_hz + 0.002 * random.Normal();
    slow += 0.002 * (random.Normal() - slow);
    x = std::cos(phase) + slow + 0.02 * random.Normal();
  }
  return out;
}

void AddLine(double amplitude, double frequency_hz, std::vector<double>* signal) {
  for (std::size_t t = 0; t < signal->size(); ++t) {
    const double turns = frequency_hz * static_cast<double>(t) / kSampling_hz;
    (*signal)[t] += amplitude * std::cos(2.0 * std::numbers::pi * turns + 0.7);
  }
}

double HumIn(const std::vector<double>& signal) {
  return HumBelowBand(signal, kSampling_hz, kCycle_hz).of_cycle;
}

TEST(HumBelowBand, NoiseHasNone) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) EXPECT_EQ(HumIn(Cycle(seed)), 0.0) << seed;
}

// The mains' frequency wanders by up to 200 mHz, and a bin is 0.5 Hz wide.
TEST(HumBelowBand, HasItsAmplitudeOverTheCycles) {
  for (const double frequency_hz : {49.8, 50.0, 60.1, 100.3, 120.0}) {
    std::vector<double> signal = Cycle(3);
    AddLine(0.1, frequency_hz, &signal);
    EXPECT_NEAR(HumIn(signal), 0.1, 0.01) << frequency_hz;
  }
}

TEST(HumBelowBand, IsAtTheMainsFrequencies) {
  for (const double frequency_hz : {45.0, 55.0, 80.0, 110.0}) {
    std::vector<double> signal = Cycle(4);
    AddLine(0.1, frequency_hz, &signal);
    EXPECT_EQ(HumIn(signal), 0.0) << frequency_hz;
  }
}

TEST(HumBelowBand, IsNoneInTheBand) {
  std::vector<double> signal = Cycle(5);
  AddLine(0.1, 50.0, &signal);
  EXPECT_EQ(HumBelowBand(signal, kSampling_hz, 330.0).of_cycle, 0.0);
  std::vector<double> high = Cycle(5);
  AddLine(0.1, 150.0, &high);
  EXPECT_EQ(HumIn(high), 0.0);
}

TEST(HumBelowBand, IsUpToTheSixthMultiple) {
  const std::vector<double> cycle = Cycle(6);
  for (const auto& [frequency_hz, seen] : {std::pair(300.0, true), std::pair(350.0, false)}) {
    std::vector<double> signal = cycle;
    AddLine(0.1, frequency_hz, &signal);
    EXPECT_EQ(HumBelowBand(signal, kSampling_hz, 2500.0).of_cycle > 0.0, seen) << frequency_hz;
  }
}

TEST(HumBelowBand, IsNoneOfASignalThatIsConstant) {
  const MainsLine none = HumBelowBand(std::vector<double>(40000, 1.5), kSampling_hz, kCycle_hz);
  EXPECT_EQ(none.of_cycle, 0.0);
}

TEST(HumBelowBand, IsAFactOfMostRecords) {
  std::vector<LoopRecord> records;
  for (std::uint64_t e = 0; e < 3; ++e) {
    Record record;
    record.sampling_hz = kSampling_hz;
    record.pressure = Cycle(10 + e);
    record.heat_release = Cycle(20 + e);
    records.push_back({std::to_string(e), 0.0, kCycle_hz, record});
  }
  AddLine(0.05, 50.0, &records[0].record.heat_release);
  EXPECT_TRUE(SampleFactsOf(records).empty());
  AddLine(0.05, 50.0, &records[1].record.heat_release);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].effect, "mains_hum");
  EXPECT_EQ(facts[0].experiments, 2u);
  EXPECT_NEAR(facts[0].value, 0.05, 0.01);
  EXPECT_EQ(facts[0].block, LoopBlock::kHeatReleaseInstrument);
  EXPECT_EQ(facts[0].line_hz, 50.0);
  EXPECT_TRUE(facts[0].rest_can_be_found);
  EXPECT_TRUE(SampleFactsOf(records, {"mains_hum"}).empty());
}

}  // namespace
}  // namespace howl::hum_below_band_test
