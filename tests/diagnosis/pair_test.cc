// Two effects at once.
#include "diagnosis/pair/pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/flame_cut.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/pair/pair_parts.h"
#include "model/effects/catalogue.h"
#include "model/effects/combined.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::pair_test {
namespace {

EffectPointer Find(std::string_view id) {
  for (EffectPointer& effect : Catalogue()) {
    if (effect->id() == id) return effect;
  }
  return nullptr;
}

void AddHum(double frequency_hz, double amplitude, std::vector<DiagnosisExperiment>* rig,
            std::vector<double> Record::*channel = &Record::heat_release) {
  for (DiagnosisExperiment& experiment : *rig) {
    for (std::size_t i = 0; i < experiment.record.pressure.size(); ++i) {
      const double t = static_cast<double>(i) / experiment.record.sampling_hz;
      (experiment.record.*channel)[i] +=
          amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * t + 0.3);
    }
  }
}

TEST(Combined, FactorsMultiplyAndNullsAreTheOther) {
  const EffectPointer low_pass = Find("q_sensor_lowpass");
  const EffectPointer skew = Find("channel_skew");
  const EffectPointer both = Combine(low_pass, skew);
  EXPECT_EQ(both->id(), "q_sensor_lowpass+channel_skew");
  ASSERT_EQ(both->parameters().size(), 2U);
  EXPECT_EQ(both->parameters()[1].name, "channel_skew.skew_s");
  const std::vector<double> x = {300.0, 2e-4};
  for (const double f : {50.0, 210.0, 900.0}) {
    // First-order low-pass and a shift, in closed form.
    const Response truth =
        std::polar(1.0, -2.0 * std::numbers::pi * f * 2e-4) / Response(1.0, f / 300.0);
    EXPECT_LT(std::abs(both->HeatReleaseInstrument(f, x) - truth), 1e-12);
    const std::vector<double> first_alone = {300.0, 0.0};
    EXPECT_EQ(both->HeatReleaseInstrument(f, first_alone),
              low_pass->HeatReleaseInstrument(f, std::vector<double>{300.0}));
  }
}

TEST(Combined, AcousticsAddTheirChanges) {
  const EffectPointer mode = Find("extra_acoustic_mode");
  const EffectPointer detuned = Find("mode_detuning");
  const EffectPointer both = Combine(mode, detuned);
  const Acoustics<double> base{205.0, 0.15, 6000.0, 1500.0, 3.0};
  std::vector<double> x;
  for (const EffectPointer& effect : {mode, detuned}) {
    for (const EffectParameter& p : effect->parameters()) x.push_back(p.starts.back());
  }
  const std::size_t n = mode->parameters().size();
  const EffectValues all(x);
  for (const double f : {150.0, 500.0, 1200.0}) {
    const Complex<double> g = AcousticResponse(base, f);
    const Response truth = mode->Acoustics(base, f, {}, all.first(n)) +
                           detuned->Acoustics(base, f, {}, all.subspan(n)) - Response(g.re, g.im);
    EXPECT_LT(std::abs(both->Acoustics(base, f, {}, x) - truth), 1e-12 * std::abs(truth));
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

void AddDropouts(RigParameters* rig) {
  EXPECT_TRUE(Find("intermittency")->AddTo({}, std::vector<double>{0.35, 0.2}, rig));
}

std::vector<DiagnosisExperiment> SlowAndIntermittent() {
  return SimulatePoints(
      3,
      [](RigParameters* rig) {
        AddDropouts(rig);
        rig->instruments = {std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)};
      },
      41);
}

TEST(Diagnose, AFluctuatingGainIsFoundGivenALowPass) {
  const Diagnosis diagnosis =
      DiagnoseAmong({"intermittency", "q_sensor_lowpass", "channel_skew"}, SlowAndIntermittent());
  EXPECT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "q_sensor_lowpass+intermittency");
}

TEST(Diagnose, ThreeEffectsAreThree) {
  std::vector<DiagnosisExperiment> rig = SlowAndIntermittent();
  AddHum(50.0, 0.05, &rig);
  const Diagnosis diagnosis =
      DiagnoseAmong({"mains_hum", "intermittency", "q_sensor_lowpass", "channel_skew"}, rig);
  EXPECT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "mains_hum+q_sensor_lowpass+intermittency");
  const Candidate& three = diagnosis.candidates.at(0);
  const auto cutoff = std::find_if(
      three.parameters.begin(), three.parameters.end(),
      [](const EstimatedParameter& p) { return p.name == "q_sensor_lowpass.cutoff_hz"; });
  ASSERT_NE(cutoff, three.parameters.end());
  EXPECT_NEAR(cutoff->value, 400.0, 20.0);
}

TEST(Diagnose, AFluctuatingGainIsFoundGivenClippedHeatRelease) {
  std::vector<DiagnosisExperiment> rig = SimulatePoints(3, AddDropouts, 43);
  CutOff(0.85, &Record::heat_release, &rig);
  const Diagnosis diagnosis = DiagnoseAmong({"intermittency", "q_clipping", "channel_skew"}, rig);
  EXPECT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "q_clipping+intermittency");
}

// With half of q lost, what its repair gets wrong looks like damping that moves with the amplitude:
// clipping alone is the answer, and the two together are not excluded.
TEST(LongDiagnose, WhatMayBeSpuriousInRepairedHeatReleaseIsNotAsserted) {
  std::vector<DiagnosisExperiment> rig = SimulateRig();
  CutOff(0.75, &Record::heat_release, &rig);
  const Diagnosis alone = DiagnoseAmong({"q_clipping", "nonlinear_damping"}, rig);
  ASSERT_EQ(alone.kind, VerdictKind::kEffect);
  EXPECT_EQ(alone.effect, "q_clipping");
  EXPECT_EQ(alone.indistinguishable, std::vector<std::string>{"q_clipping+nonlinear_damping"});
  EXPECT_GT(alone.candidates[0].probability, 0.8);

  AddHum(350.0, 0.05, &rig, &Record::pressure);
  const Diagnosis hum =
      DiagnoseAmong({"q_clipping", "nonlinear_damping", "mains_hum", "external_tone"}, rig);
  EXPECT_EQ(hum.effect, "mains_hum+q_clipping");
  EXPECT_EQ(hum.indistinguishable,
            std::vector<std::string>{"mains_hum+q_clipping+nonlinear_damping"});
}

// Nor is one that is there: of those that gain as much, artefacts are as many.
TEST(Diagnose, ASpreadOfDelaysBesideClippedHeatReleaseIsNotAsserted) {
  std::vector<DiagnosisExperiment> rig = SimulatePoints(
      3,
      [](RigParameters* one) {
        EXPECT_TRUE(Find("delay_dispersion")->AddTo({}, std::vector<double>{4e-4}, one));
      },
      47);
  CutOff(0.85, &Record::heat_release, &rig);
  const Diagnosis diagnosis = DiagnoseAmong({"q_clipping", "delay_dispersion"}, rig);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "q_clipping");
  EXPECT_EQ(diagnosis.indistinguishable, std::vector<std::string>{"q_clipping+delay_dispersion"});
}

TEST(Diagnose, AnExtraModeIsFoundGivenFewLevels) {
  std::vector<DiagnosisExperiment> rig = SimulatePoints(
      3, [](RigParameters* one) { AddMode(2.2, 0.04, 0.05, one); }, 47);
  for (DiagnosisExperiment& experiment : rig) {
    std::vector<double>& p = experiment.record.pressure;
    const double step = (*std::max_element(p.begin(), p.end())) / 50.0;
    for (double& x : p) x = step * std::round(x / step);
  }
  const Diagnosis diagnosis =
      DiagnoseAmong({"extra_acoustic_mode", "quantisation", "channel_skew"}, rig);
  EXPECT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "quantisation+extra_acoustic_mode");
}

Attempt Gaining(const std::string& effect, LoopBlock block, double gain) {
  Attempt out;
  out.candidate.effect = effect;
  out.candidate.block = block;
  out.candidate.gain = gain;
  out.candidate.parameters = {{"size", 1.0, 0.9, 1.1, ""}};
  return out;
}

// 100 nats: odds fall by e in 1.6, and four of these make a class.
TEST(Pair, SecondsNearTheBestStayInTheClass) {
  const std::vector<Attempt> near =
      NearBest({Gaining("flame_lowpass", LoopBlock::kFlame, 100.0),
                Gaining("second_delay_path", LoopBlock::kDelay, 94.0),
                Gaining("delay_dispersion", LoopBlock::kDelay, 93.0)});
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[1].candidate.effect, "second_delay_path");
  EXPECT_TRUE(NearBest({}).empty());
}

TEST(Pair, JoiningKeepsNamesBlocksAndWhatTheLastBrings) {
  const Attempt two = Join(Gaining("channel_skew", LoopBlock::kHeatReleaseInstrument, 500.0),
                           Gaining("intermittency", LoopBlock::kFlame, 40.0));
  EXPECT_EQ(two.candidate.effect, "channel_skew+intermittency");
  EXPECT_DOUBLE_EQ(two.candidate.gain, 540.0);
  EXPECT_DOUBLE_EQ(two.second_gain, 40.0);
  const Attempt three = Join(Gaining("mains_hum", LoopBlock::kPressureInstrument, 7000.0), two);
  EXPECT_EQ(three.candidate.effect, "mains_hum+channel_skew+intermittency");
  EXPECT_EQ(three.candidate.block, LoopBlock::kPressureInstrument);
  EXPECT_EQ(three.also,
            (std::vector<LoopBlock>{LoopBlock::kHeatReleaseInstrument, LoopBlock::kFlame}));
  EXPECT_DOUBLE_EQ(three.second_gain, 40.0);
  ASSERT_EQ(three.candidate.parameters.size(), 3u);
  EXPECT_EQ(three.candidate.parameters[0].name, "mains_hum.size");
  EXPECT_EQ(three.candidate.parameters[1].name, "channel_skew.size");
  EXPECT_EQ(three.candidate.parameters[2].name, "intermittency.size");
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

// The columns of every transfer effect against central differences of the residual at fixed
// coefficients.
TEST(FlameCut, JacobianAgreesWithCentralDifferences) {
  const std::vector<CutRecord> records = MakeCutRecords({SimulateRig()[0]});
  const CutRecord& record = records[0];
  const double tau = 0.0035;
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(record.flame_count);
  std::size_t checked = 0;
  for (const EffectPointer& effect : Catalogue()) {
    if (effect->kind() != EffectKind::kTransfer || !effect->ChangesFlameCut()) continue;
    std::vector<double> x;
    Eigen::VectorXd steps(static_cast<Eigen::Index>(effect->parameters().size()));
    for (const EffectParameter& p : effect->parameters()) {
      x.push_back(p.starts.back());
      steps[static_cast<Eigen::Index>(x.size()) - 1] = 1e-5 * std::max(std::abs(x.back()), 1e-3);
    }
    const FlameColumns columns = MakeFlameColumns(record, *effect, x, tau);
    const FlameSolution at = SolveFlame(record, *effect, x, tau, columns, weight);
    const Eigen::MatrixXcd jacobian = FlameJacobian(record, *effect, x, tau, columns, at, steps);
    // The whole predicted signal, in time, with the coefficients held: another path than the
    // Jacobian's.
    const auto residual = [&](const std::vector<double>& values, double delay) {
      FlameColumns moved = columns;
      if (effect->ChangesFlameInput() || effect->ModulatesDelay()) {
        moved = MakeFlameColumns(record, *effect, values, delay);
        // Knots stay where they were.
        if (std::abs(moved.range / columns.range - 1.0) > 0.0) return Eigen::VectorXcd();
      }
      const Eigen::VectorXcd h = FlameMultiplier(record, *effect, values, delay);
      const Eigen::VectorXcd phi = moved.spectrum * at.coefficients;
      Eigen::VectorXcd out = record.windowed_heat_release.head(record.flame_count) -
                             ApplyWindow(h.cwiseProduct(phi), record.flame_count);
      const Response leak = effect->PressureLeak(record.at.cycle_frequency_hz, record.at, values);
      out -= leak * record.windowed_pressure.head(record.flame_count);
      return out;
    };
    const double by_tau = 1e-9;
    const Eigen::VectorXcd up = residual(x, tau + by_tau);
    const Eigen::VectorXcd down = residual(x, tau - by_tau);
    if (up.size() > 0 && down.size() > 0) {
      const Eigen::VectorXcd numeric = (up - down) / (2.0 * by_tau);
      EXPECT_LT((jacobian.col(0) - numeric).norm(), 1e-4 * numeric.norm()) << effect->id();
      ++checked;
    }
    for (Eigen::Index j = 0; j < steps.size(); ++j) {
      std::vector<double> more = x;
      std::vector<double> less = x;
      more[static_cast<std::size_t>(j)] += steps[j];
      less[static_cast<std::size_t>(j)] -= steps[j];
      const Eigen::VectorXcd right = residual(more, tau);
      const Eigen::VectorXcd left = residual(less, tau);
      if (right.size() == 0 || left.size() == 0) continue;
      const Eigen::VectorXcd numeric = (right - left) / (2.0 * steps[j]);
      EXPECT_LT((jacobian.col(1 + j) - numeric).norm(), 1e-3 * numeric.norm() + 1e-9)
          << effect->id() << " " << j;
      ++checked;
    }
  }
  EXPECT_GE(checked, 6U);
}

}  // namespace
}  // namespace howl::pair_test
