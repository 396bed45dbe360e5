// Saturated p is declipped, and other effects are then found given the saturation.
#include "diagnosis/declip/declip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/samples/sample_limits.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::declip_test {
namespace {

constexpr double kPressureNoise = 0.02;  // of TestRig, in every sample

// Three samples of ten are on a plateau.
std::vector<DiagnosisExperiment> Clipped(std::vector<DiagnosisExperiment> rig) {
  CutOff(0.85, &Record::pressure, &rig);
  return rig;
}

TEST(FindPlateaus, OneEndTwoEndsOrNone) {
  Eigen::VectorXd x(4000);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = std::sin(0.0731 * static_cast<double>(i)) + 0.1 * std::sin(1.37 * double(i));
  }
  EXPECT_EQ(FindPlateaus(x).upper.sum() + FindPlateaus(x).lower.sum(), 0.0);
  const Eigen::VectorXd one = x.cwiseMin(0.8);
  EXPECT_EQ(FindPlateaus(one).upper.sum(), static_cast<double>((x.array() >= 0.8).count()));
  EXPECT_EQ(FindPlateaus(one).lower.sum(), 0.0);
  const Eigen::VectorXd two = one.cwiseMax(-0.7);
  EXPECT_EQ(FindPlateaus(two).lower.sum(), static_cast<double>((x.array() <= -0.7).count()));
}

// The truth is the record before it was cut off, whose sensor noise cannot be put back.
TEST(Declip, PutsBackWhatWasCutOffButItsNoise) {
  const std::vector<DiagnosisExperiment> rig = SimulateRig();
  const std::vector<CutRecord> whole = MakeCutRecords(rig);
  const std::vector<CutRecord> recorded = MakeCutRecords(Clipped(rig));
  const Declipped declipped = DeclipAnew(recorded, recorded, FitBase(recorded), 1);
  for (std::size_t e = 0; e < rig.size(); ++e) {
    const Plateaus plateaus = FindPlateaus(recorded[e].pressure);
    Eigen::ArrayXd on = plateaus.upper + plateaus.lower;
    EXPECT_NEAR(on.mean(), 0.3, 0.01);
    // The ends do not know what came before, and the window leaves them out.
    on.head(on.size() / 20).setZero();
    on.tail(on.size() / 20).setZero();
    const auto rms = [&](const Eigen::VectorXd& x) {
      return std::sqrt((on * (x - whole[e].pressure).array().square()).sum() / on.sum());
    };
    EXPECT_LT(rms(declipped.pressure[e]), 1.15 * kPressureNoise) << e;
    EXPECT_GT(rms(recorded[e].pressure), 20.0 * kPressureNoise) << e;
  }
}

// They are the whole records', though a third of the samples is missing.
TEST(Declip, AcousticsAreThoseOfTheWholeRecord) {
  const std::vector<CutRecord> whole = MakeCutRecords(SimulateRig());
  const std::vector<CutRecord> recorded = MakeCutRecords(Clipped(SimulateRig()));
  const EffectFit full = FitBase(whole);
  const EffectFit base = FitBase(recorded);
  const Declipped declipped = DeclipAnew(recorded, recorded, base, 2);
  for (std::size_t e = 0; e < whole.size(); ++e) {
    const AcousticLocals& truth = full.experiments[e].acoustics;
    const AcousticLocals& found = declipped.fit.experiments[e].acoustics;
    EXPECT_NEAR(found[0], truth[0], 2e-4);
    EXPECT_NEAR(found[1], truth[1], 5e-3);
    EXPECT_NEAR(found[2], truth[2], 5e-3 * truth[2]);
    EXPECT_GT(std::abs(base.experiments[e].acoustics[2] - truth[2]), 0.02 * truth[2]);
  }
}

TEST(Declip, LeavesARecordWithoutPlateausAlone) {
  const std::vector<CutRecord> records = MakeCutRecords(SimulateRig());
  const EffectFit base = FitBase(records);
  const Declipped declipped = DeclipAnew(records, records, base, 1);
  EXPECT_LT((declipped.pressure[0] - records[0].pressure).norm(),
            1e-12 * records[0].pressure.norm());
}

// The flame's delay is the rig's own again, which the cut-off record's fit misses.
TEST(Diagnose, ClippedPressureAloneLeavesNoiseOnceItIsRepaired) {
  const Diagnosis diagnosis =
      DiagnoseAmong({"p_clipping", "second_delay_path", "extra_acoustic_mode", "channel_skew"},
                    Clipped(SimulateRig()));
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "p_clipping");
  EXPECT_EQ(diagnosis.repaired, "p_clipping");
  EXPECT_TRUE(diagnosis.indistinguishable.empty());
  EXPECT_GT(diagnosis.candidates[0].probability, 0.9);
  EXPECT_LT(diagnosis.gap_after, 1.2 * diagnosis.gap_floor);
  EXPECT_GT(diagnosis.gap_before, 5.0 * diagnosis.gap_floor);
  ASSERT_EQ(diagnosis.where.size(), 1u);
  EXPECT_EQ(diagnosis.where[0].block, LoopBlock::kPressureInstrument);
  ASSERT_FALSE(diagnosis.base_parameters.empty());
  EXPECT_NEAR(diagnosis.base_parameters[0].with, 0.00352, 2e-5);
}

// A recorder's noise spreads the plateaus: no value repeats.
TEST(Diagnose, ClippedPressureUnderNoiseIsRepairedToo) {
  std::vector<DiagnosisExperiment> rig = Clipped(SimulateRig());
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, kPressureNoise);
  for (DiagnosisExperiment& experiment : rig) {
    for (double& p : experiment.record.pressure) p += noise(random);
  }
  const Diagnosis diagnosis =
      DiagnoseAmong({"p_clipping", "extra_acoustic_mode", "channel_skew"}, rig);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "p_clipping");
  EXPECT_LT(diagnosis.gap_after, 1.2 * diagnosis.gap_floor);
}

TEST(LongDiagnose, AnExtraModeIsFoundGivenClippedPressure) {
  const Diagnosis diagnosis =
      DiagnoseAmong({"p_clipping", "extra_acoustic_mode", "channel_skew"},
                    Clipped(SimulatePoints(
                        3, [](RigParameters* one) { AddMode(2.2, 0.04, 0.05, one); }, 47)));
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "p_clipping+extra_acoustic_mode");
  EXPECT_LT(diagnosis.gap_after, 1.2 * diagnosis.gap_floor);
  const auto& parameters = diagnosis.candidates[0].parameters;
  const auto ratio = std::find_if(
      parameters.begin(), parameters.end(),
      [](const EstimatedParameter& p) { return p.name == "extra_acoustic_mode.ratio"; });
  ASSERT_NE(ratio, parameters.end());
  EXPECT_NEAR(ratio->value, 2.2, 0.02);
}

TEST(LongDiagnose, ALowPassOfQIsFoundGivenClippedPressure) {
  const Diagnosis diagnosis = DiagnoseAmong(
      {"p_clipping", "q_sensor_lowpass", "extra_acoustic_mode"},
      Clipped(SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)})));
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "p_clipping+q_sensor_lowpass");
  const auto& parameters = diagnosis.candidates[0].parameters;
  ASSERT_EQ(parameters.size(), 2u);
  EXPECT_LT(parameters[1].low, 400.0);
  EXPECT_GT(parameters[1].high, 400.0);
}

// Under the base's filling the form of first order fits better.
TEST(LongDiagnose, TheFormOfALowPassIsFoundGivenClippedPressure) {
  const double cutoff_hz = 270.0;
  const Diagnosis diagnosis =
      DiagnoseAmong({"p_clipping", "q_sensor_lowpass"},
                    Clipped(SimulateRig({std::make_shared<SecondOrderResponse>(
                        Channel::kHeatRelease, cutoff_hz, std::sqrt(0.5))})));
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "p_clipping+q_sensor_lowpass");
  EXPECT_NEAR(diagnosis.candidates[0].parameters.at(1).value, cutoff_hz, 0.01 * cutoff_hz);
  EXPECT_LT(diagnosis.gap_after, 1.2 * diagnosis.gap_floor);
}

// q does not drive it, so that it goes on while p is on its plateau.
TEST(Diagnose, HumInPressureIsFoundGivenItsClipping) {
  std::vector<DiagnosisExperiment> rig = SimulateRig();
  for (DiagnosisExperiment& experiment : rig) {
    Record& record = experiment.record;
    for (std::size_t i = 0; i < record.pressure.size(); ++i) {
      const double t = static_cast<double>(i) / record.sampling_hz;
      record.pressure[i] += 0.3 * std::sin(2.0 * std::numbers::pi * 150.0 * t);
    }
  }
  const std::vector<std::string> kept = {"p_clipping", "mains_hum", "external_tone"};
  const Diagnosis whole = DiagnoseAmong(kept, rig);
  ASSERT_EQ(whole.effect, "mains_hum");
  const Diagnosis clipped = DiagnoseAmong(kept, Clipped(rig));
  ASSERT_EQ(clipped.kind, VerdictKind::kEffect);
  EXPECT_EQ(clipped.effect, "p_clipping+mains_hum");
  EXPECT_NEAR(clipped.gap_after, whole.gap_after, 0.01);
  EXPECT_GT(clipped.gap_before, 10.0 * whole.gap_before);
}

TEST(Diagnose, FewLevelsAreSeenBesideClippedPressure) {
  std::vector<DiagnosisExperiment> rig = SimulateRig();
  for (DiagnosisExperiment& experiment : rig) {
    std::vector<double>& p = experiment.record.pressure;
    const double step = (*std::max_element(p.begin(), p.end())) / 60.0;
    for (double& x : p) x = step * std::round(x / step);
  }
  const Diagnosis diagnosis =
      DiagnoseAmong({"p_clipping", "quantisation", "channel_skew"}, Clipped(rig));
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "p_clipping+quantisation");
}

TEST(LongDiagnose, WhatIsNotInTheCatalogueIsUnknownGivenClippedPressure) {
  const Diagnosis diagnosis = DiagnoseAmong(
      {"p_clipping", "delay_varies_with_phi"},
      Clipped(SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)})));
  EXPECT_EQ(diagnosis.kind, VerdictKind::kUnknown);
  EXPECT_EQ(diagnosis.repaired, "p_clipping");
  EXPECT_TRUE(diagnosis.effect.empty());
  const auto lagging = std::find_if(
      diagnosis.where.begin(), diagnosis.where.end(),
      [](const Place& place) { return place.block == LoopBlock::kHeatReleaseInstrument; });
  ASSERT_NE(lagging, diagnosis.where.end());
  EXPECT_GT(lagging->share, 0.4);  // half belongs to the clipping
}

}  // namespace
}  // namespace howl::declip_test
