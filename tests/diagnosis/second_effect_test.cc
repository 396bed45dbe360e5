// What the search for one cause says where there are two.
#include "diagnosis/search/second_effect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/diagnosis/simulated_rig.h"

namespace howl::second_effect_test {
namespace {

void AddHum(double frequency_hz, double amplitude, std::vector<DiagnosisExperiment>* rig) {
  for (DiagnosisExperiment& experiment : *rig) {
    for (std::size_t i = 0; i < experiment.record.pressure.size(); ++i) {
      const double t = static_cast<double>(i) / experiment.record.sampling_hz;
      experiment.record.heat_release[i] +=
          amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * t + 0.3);
    }
  }
}

TEST(Diagnose, HumAndALowPassAreTwoEffects) {
  std::vector<DiagnosisExperiment> rig =
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)});
  AddHum(50.0, 0.05, &rig);
  const Diagnosis diagnosis =
      DiagnoseAmong({"mains_hum", "external_tone", "q_sensor_lowpass", "channel_skew"}, rig);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "mains_hum+q_sensor_lowpass");
  EXPECT_LT(diagnosis.gap_after, 0.3 * diagnosis.gap_before);
}

TEST(Diagnose, HumAloneIsOneEffect) {
  std::vector<DiagnosisExperiment> rig = SimulateRig();
  AddHum(50.0, 0.05, &rig);
  const Diagnosis diagnosis =
      DiagnoseAmong({"mains_hum", "external_tone", "q_sensor_lowpass", "channel_skew"}, rig);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "mains_hum");
}

std::vector<DiagnosisExperiment> RigWithAMode() {
  return SimulatePoints(
      3, [](RigParameters* one) { AddMode(2.2, 0.04, 0.05, one); }, 47);
}

void ExpectAlone(const char* effect, const std::vector<DiagnosisExperiment>& rig) {
  const Diagnosis diagnosis =
      DiagnoseAmong({"p_clipping", "q_clipping", "quantisation", "extra_acoustic_mode"}, rig);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, effect);
  EXPECT_TRUE(diagnosis.indistinguishable.empty());
  EXPECT_GT(diagnosis.candidates[0].probability, 0.9);
  EXPECT_NE(diagnosis.advice.find("record again"), std::string::npos) << diagnosis.advice;
}

// What is fitted to samples that were changed speaks of what was done to them.
TEST(Diagnose, NothingIsNamedBesideFewLevels) {
  std::vector<DiagnosisExperiment> rig = RigWithAMode();
  for (DiagnosisExperiment& experiment : rig) {
    std::vector<double>& p = experiment.record.pressure;
    const double step = std::ranges::max(p) / 50.0;
    for (double& x : p) x = step * std::round(x / step);
  }
  ExpectAlone("quantisation", rig);
}

TEST(Diagnose, NothingIsNamedBesideClipping) {
  for (const auto& [effect, channel] : {std::pair("p_clipping", &Record::pressure),
                                        std::pair("q_clipping", &Record::heat_release)}) {
    std::vector<DiagnosisExperiment> rig = RigWithAMode();
    CutOff(0.85, channel, &rig);
    ExpectAlone(effect, rig);
  }
}

// A recorder's noise spreads the plateaus: no value repeats.
TEST(Diagnose, ClippedPressureIsSeenUnderNoise) {
  std::vector<DiagnosisExperiment> rig = SimulateRig();
  CutOff(0.85, &Record::pressure, &rig);
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (DiagnosisExperiment& experiment : rig) {
    for (double& p : experiment.record.pressure) p += noise(random);
  }
  ExpectAlone("p_clipping", rig);
}

Attempt Gaining(const std::string& effect, LoopBlock block, EffectKind kind, double gain) {
  Attempt out;
  out.candidate.effect = effect;
  out.candidate.block = block;
  out.candidate.gain = gain;
  out.candidate.parameters = {{"size", 1.0, 0.9, 1.1, ""}};
  out.kind = kind;
  return out;
}

// 100 nats: odds fall by e in 1.6, and four of these make a class.
TEST(BesideALine, NamesTheBestOfTheOthersAndThoseNearIt) {
  const std::vector<Attempt> found =
      BesideALine({Gaining("mains_hum", LoopBlock::kPressureInstrument, EffectKind::kHum, 7000.0),
                   Gaining("flame_lowpass", LoopBlock::kFlame, EffectKind::kTransfer, 100.0),
                   Gaining("second_delay_path", LoopBlock::kDelay, EffectKind::kTransfer, 94.0),
                   Gaining("delay_dispersion", LoopBlock::kDelay, EffectKind::kTransfer, 93.0)});
  ASSERT_EQ(found.size(), 2u);
  const Attempt& best = found[0];
  EXPECT_EQ(best.candidate.effect, "mains_hum+flame_lowpass");
  EXPECT_EQ(best.candidate.block, LoopBlock::kPressureInstrument);
  EXPECT_EQ(best.also, LoopBlock::kFlame);
  EXPECT_DOUBLE_EQ(best.candidate.gain, 7100.0);
  EXPECT_DOUBLE_EQ(best.second_gain, 100.0);
  ASSERT_EQ(best.candidate.parameters.size(), 2u);
  EXPECT_EQ(best.candidate.parameters[0].name, "mains_hum.size");
  EXPECT_EQ(best.candidate.parameters[1].name, "flame_lowpass.size");
  EXPECT_EQ(found[1].candidate.effect, "mains_hum+second_delay_path");
}

TEST(BesideALine, IsNothingWithoutALineOrWithoutAnother) {
  const Attempt line = Gaining("mains_hum", LoopBlock::kPressureInstrument, EffectKind::kHum, 50.0);
  const Attempt weak = Gaining("channel_skew", LoopBlock::kDelay, EffectKind::kTransfer, 1.0);
  const Attempt skew = Gaining("channel_skew", LoopBlock::kDelay, EffectKind::kTransfer, 90.0);
  EXPECT_TRUE(BesideALine({}).empty());
  EXPECT_TRUE(BesideALine({line}).empty());
  EXPECT_TRUE(BesideALine({line, weak}).empty());
  EXPECT_TRUE(BesideALine({skew, weak}).empty());
}

TEST(LongDiagnose, ASecondTransferFunctionMakesTheVerdictUnknown) {
  const Diagnosis diagnosis = DiagnoseAmong(
      {"extra_acoustic_mode", "q_sensor_lowpass", "crosstalk_p_to_q"},
      SimulatePoints(
          3,
          [](RigParameters* rig) {
            AddMode(2.2, 0.04, 0.05, rig);
            rig->instruments = {std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)};
          },
          45));
  EXPECT_EQ(diagnosis.kind, VerdictKind::kUnknown);
  EXPECT_EQ(diagnosis.together, "q_sensor_lowpass+extra_acoustic_mode");
}

TEST(LongDiagnose, AModeOnTopOfAModeIsNoCauseOfItsOwn) {
  const Diagnosis diagnosis =
      DiagnoseAmong({"extra_acoustic_mode", "channel_skew"},
                    SimulatePoints(
                        3, [](RigParameters* rig) { AddMode(3.0, 0.05, 0.1, rig); }, 49));
  EXPECT_EQ(diagnosis.kind, VerdictKind::kUnknown);
  ASSERT_FALSE(diagnosis.where.empty());
  EXPECT_EQ(diagnosis.where[0].block, LoopBlock::kAcoustics);
}

TEST(LongDiagnose, AnEdgeInTheSamplesThatNothingExplainsIsUnknown) {
  std::vector<DiagnosisExperiment> rig = SimulateRig();
  CutOff(0.8, &Record::pressure, &rig);
  const Diagnosis diagnosis =
      DiagnoseAmong({"second_delay_path", "channel_skew", "q_clipping"}, rig);
  EXPECT_EQ(diagnosis.kind, VerdictKind::kUnknown);
  ASSERT_FALSE(diagnosis.where.empty());
  EXPECT_EQ(diagnosis.where[0].block, LoopBlock::kPressureInstrument);
}

// It is as free as the low-pass, yet what it learns on two points is of no use on the third.
TEST(Diagnose, APlaceboLeavesTheGap) {
  const Diagnosis diagnosis = DiagnoseAmong(
      {"q_sensor_lowpass", "channel_skew"},
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)}));
  EXPECT_EQ(diagnosis.effect, "q_sensor_lowpass");
  EXPECT_GT(diagnosis.candidates[0].shrinkage, 0.8);
  EXPECT_LT(diagnosis.placebo_shrinkage, 0.03);
}

}  // namespace
}  // namespace howl::second_effect_test
