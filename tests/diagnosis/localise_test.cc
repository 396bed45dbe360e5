// Rigs from the project's own simulator with one thing wrong at a known place: free slack must find
// the place without any effect of the catalogue.
#include "diagnosis/localise/localise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/localise/free_additive.h"
#include "diagnosis/localise/free_factor.h"
#include "diagnosis/localise/place.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::localise_test {
namespace {

std::vector<BlockSlack> LocaliseRig(const std::vector<DiagnosisExperiment>& experiments) {
  std::vector<CutRecord> records = MakeCutRecords(experiments);
  const std::vector<CoherentLine> lines = FindCoherentLines(records);
  MaskLines(lines, &records);
  const EffectFit base = FitBase(records);
  const AttemptContext at{&records, &base, &experiments, {}, nullptr, nullptr};
  return Localise(at, lines, ExplainLines(records, base, lines),
                  EstimateGainFluctuation(records, base), 2);
}

const BlockSlack& Best(const std::vector<BlockSlack>& slacks) {
  return *std::max_element(
      slacks.begin(), slacks.end(),
      [](const BlockSlack& a, const BlockSlack& b) { return a.gain < b.gain; });
}

TEST(Localise, NothingWrongGainsLittleAnywhere) {
  for (const BlockSlack& slack : LocaliseRig(SimulateRig())) {
    EXPECT_LT(slack.gain, 25.0) << slack.form;
    EXPECT_FALSE(slack.model_free) << slack.form;
  }
}

TEST(LongLocalise, FilterOnRecordedHeatRelease) {
  const BlockSlack best = Best(LocaliseRig(
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)})));
  EXPECT_EQ(best.block, LoopBlock::kHeatReleaseInstrument) << best.form;
  EXPECT_GT(best.gain, 100.0);
}

TEST(LongLocalise, FilterOnRecordedPressure) {
  const BlockSlack best = Best(LocaliseRig(
      SimulateRig({std::make_shared<SecondOrderResponse>(Channel::kPressure, 900.0, 0.2)})));
  EXPECT_EQ(best.block, LoopBlock::kPressureInstrument) << best.form;
  EXPECT_GT(best.gain, 100.0);
}

// A bent channel, bent here and not by the simulator.
TEST(LongLocalise, StaticMapOfAChannel) {
  for (const bool pressure : {true, false}) {
    std::vector<DiagnosisExperiment> experiments = SimulateRig();
    for (DiagnosisExperiment& experiment : experiments) {
      std::vector<double>& x =
          pressure ? experiment.record.pressure : experiment.record.heat_release;
      double largest = 0.0;
      for (const double value : x) largest = std::max(largest, std::abs(value));
      for (double& value : x) value += 0.15 * value * value / largest;
    }
    const BlockSlack best = Best(LocaliseRig(experiments));
    EXPECT_EQ(best.block,
              pressure ? LoopBlock::kPressureInstrument : LoopBlock::kHeatReleaseInstrument)
        << best.form;
  }
}

TEST(LongLocalise, NoiseAddedToRecordedPressure) {
  std::vector<DiagnosisExperiment> experiments = SimulateRig();
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  for (DiagnosisExperiment& experiment : experiments) {
    double square = 0.0;
    for (const double value : experiment.record.pressure) square += value * value;
    const double rms = std::sqrt(square / static_cast<double>(experiment.record.pressure.size()));
    // A band of noise around 2.6 times the cycle's frequency.
    double a = 0.0;
    double b = 0.0;
    const double radius = 0.98;
    const double angle = 2.0 * M_PI * 540.0 / experiment.record.sampling_hz;
    for (double& value : experiment.record.pressure) {
      const double next = 2.0 * radius * std::cos(angle) * a - radius * radius * b +
                          0.004 * rms * normal(generator);
      b = a;
      a = next;
      value += a;
    }
  }
  const std::vector<BlockSlack> slacks = LocaliseRig(experiments);
  const BlockSlack& best = Best(slacks);
  EXPECT_EQ(best.block, LoopBlock::kPressureInstrument) << best.form;
  EXPECT_LT(best.low_hz, 540.0);
  EXPECT_GT(best.high_hz, 540.0);
}

// exp(c ((s - a) / (s + a))): at s = 0 exp(-c), at s = j a the step is j, far away exp(c).
TEST(FreeFactor, ClosedForm) {
  const std::vector<double> c = {0.3};
  EXPECT_NEAR(std::abs(FreeFactor(0.0, 100.0, c, {}) - std::exp(-0.3)), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(FreeFactor(100.0, 100.0, c, {}) - std::polar(1.0, 0.3)), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(FreeFactor(1e12, 100.0, c, {}) - std::exp(0.3)), 0.0, 1e-9);
  // Causal and anticausal parts with the same coefficients: the phase is gone.
  EXPECT_NEAR(std::arg(FreeFactor(130.0, 100.0, c, c)), 0.0, 1e-12);
  // A low-pass of first order: f0 / (2 zeta) with the section's second pole far above.
  const std::vector<double> section = {1e7, 1e5 / 2.0, 0.0, 0.0};
  EXPECT_NEAR(std::abs(FreeSection(100.0, section) - 1.0 / Response(1.0, 1.0)), 0.0, 1e-4);
}

}  // namespace
}  // namespace howl::localise_test
