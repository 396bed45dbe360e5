// What a diagnosis has to find of itself: saturation by its repeated values, and nothing where
// noise alone is strong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/gap/slack.h"
#include "diagnosis/samples/sample_limits.h"
#include "diagnosis/samples/static_map.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::cut_bias_test {
namespace {

std::vector<DiagnosisExperiment> NoisyRig(std::uint64_t seed) {
  return SimulatePoints(
      4,
      [](RigParameters* rig) {
        rig->noise.combustion_density = 2.5e-6;  // a tenth of the flame's range, and more
        rig->noise.combustion_corner_hz = 1600.0;
      },
      seed);
}

// Combustion noise comes back to the flame through the acoustics. Least squares over a band that
// ends at once is a filter that looks ahead: it finds in p the noise that made it, as a second
// path of short delay.
TEST(CutB, StrongCombustionNoiseLeavesNothingForAFreeFilter) {
  std::vector<CutRecord> records = MakeCutRecords(NoisyRig(5));
  const EffectFit base = FitBase(records);
  EXPECT_LT(ComputeSlack(records, base).flame_excess, 25.0);
  const EffectFit second = FitEffect(records, SecondDelayPath()[0], base);
  EXPECT_LT(base.cost() - second.cost(), 12.0);

  // With the edge left sharp the same records do deceive it.
  for (CutRecord& record : records) record.flame_share.setOnes();
  const EffectFit sharp = FitBase(records);
  EXPECT_GT(ComputeSlack(records, sharp).flame_excess, 50.0);
}

// A second-order low-pass leaves q less than its noise at high frequencies. As a regressor that is
// noise biases the acoustics, and free slack finds the bias.
TEST(CutA, NoiseOfLowPassedHeatReleaseLeavesNothingForFreeSlack) {
  const double cutoff_hz = 240.0;
  const std::vector<DiagnosisExperiment> rig = SimulateRig(
      {std::make_shared<SecondOrderResponse>(Channel::kHeatRelease, cutoff_hz, std::sqrt(0.5))});
  const auto fit = [](const std::vector<CutRecord>& records) {
    return FitEffect(records, QSensorLowPass()[1], FitBase(records));
  };
  std::vector<CutRecord> records = MakeCutRecords(rig);
  const EffectFit right = fit(records);
  EXPECT_LT(ComputeSlack(records, right).acoustic_excess, 10.0);
  EXPECT_NEAR(right.values[0], cutoff_hz, 0.01 * cutoff_hz);

  for (CutRecord& record : records) {
    record.driving_heat_release =
        record.heat_release_spectrum.segment(record.first - kTapReach, record.extended());
  }
  EXPECT_GT(ComputeSlack(records, fit(records)).acoustic_excess, 100.0);
}

TEST(Clipping, RepeatedExtremesAreSeenHoweverFewAreCutOff) {
  std::vector<DiagnosisExperiment> experiments = SimulateRig();
  const auto edge = [&](const std::vector<DiagnosisExperiment>& of) {
    const std::vector<CutRecord> records = MakeCutRecords(of);
    return FitClipping(records, Channel::kPressure, FitBase(records)).sharp_edge;
  };
  EXPECT_FALSE(edge(experiments));
  std::vector<DiagnosisExperiment> coarse = experiments;
  for (DiagnosisExperiment& one : coarse) {
    for (double& p : one.record.pressure) p = 0.5 * std::round(p / 0.5);
  }
  EXPECT_FALSE(edge(coarse)) << "levels are no rail";
  for (DiagnosisExperiment& one : experiments) {
    std::vector<double> sorted = one.record.pressure;
    std::sort(sorted.begin(), sorted.end());
    const double rail = sorted[sorted.size() * 97 / 100];
    for (double& p : one.record.pressure) p = std::min(p, rail);
  }
  EXPECT_TRUE(edge(experiments));
}

// Of q the density ends in edges in both: p alone tells them apart.
TEST(LongClipping, OfHeatReleaseIsToldFromAFlameThatSaturatesAsSharply) {
  const auto has_edges = [](const std::vector<DiagnosisExperiment>& rig) {
    return HasSharpEdge(MakeCutRecords(rig), Channel::kHeatRelease);
  };
  const std::vector<std::string> among = {"q_clipping", "flame_lowpass"};
  const std::vector<DiagnosisExperiment> sharp = SimulatePoints(
      3,
      [](RigParameters* rig) {
        rig->model.flame.slope *= 3.0;
        rig->noise.combustion_density = 1e-11;
        rig->noise.heat_release_sensor_std = 5e-4;
      },
      7);
  ASSERT_TRUE(has_edges(sharp));
  EXPECT_NE(DiagnoseAmong(among, sharp).effect, "q_clipping");

  std::vector<DiagnosisExperiment> clipped = SimulateRig();
  CutOff(0.85, &Record::heat_release, &clipped);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 5e-4);
  for (DiagnosisExperiment& one : clipped) {
    for (double& q : one.record.heat_release) q += noise(random);
  }
  ASSERT_TRUE(has_edges(clipped));
  EXPECT_EQ(DiagnoseAmong(among, clipped).effect, "q_clipping");
}

}  // namespace
}  // namespace howl::cut_bias_test
