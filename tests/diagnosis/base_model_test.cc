// The base is the config's loop: one mode or two, the second at the config's ratio.
#include "diagnosis/records/base_model.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/search/choose_modes.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::base_model_test {
namespace {

constexpr double kOtherRatio = 2.8;

std::vector<DiagnosisExperiment> OneModeRig(const std::function<void(RigParameters*)>& change =
                                                [](RigParameters*) {}) {
  return SimulatePoints(
      3,
      [&](RigParameters* rig) {
        rig->model.loop.acoustics.M = 0.0;
        change(rig);
      },
      11);
}

std::vector<DiagnosisExperiment> OtherRatioRig() {
  return SimulatePoints(
      3, [](RigParameters* rig) { rig->model.loop.acoustics.harmonic_ratio = kOtherRatio; }, 12);
}

Diagnosis DiagnoseAgainst(const BaseModel& model, const std::vector<DiagnosisExperiment>& rig) {
  DiagnosisOptions options;
  options.model = model;
  options.withheld = AllBut({"q_sensor_lowpass", "channel_skew", "extra_acoustic_mode",
                             "mode_detuning", "second_delay_path", "nonlinear_damping"});
  return Diagnose(rig, options);
}

TEST(BaseModel, WithOneModeTheSecondIsNowhere) {
  const std::vector<CutRecord> records = MakeCutRecords(OneModeRig(), {.modes = 1});
  const EffectFit fit = FitBase(records);
  for (int point = 0; point < 3; ++point) {
    const Acoustics<double> truth = TestRig(point).model.loop.acoustics;
    const AcousticLocals& locals = fit.experiments[static_cast<std::size_t>(point)].acoustics;
    const Acoustics<double> found = ToAcoustics({.modes = 1}, locals);
    EXPECT_EQ(found.M, 0.0);
    EXPECT_NEAR(found.omega_hz / truth.omega_hz, 1.0, 2e-3);
    EXPECT_NEAR(found.xi / truth.xi, 1.0, 0.03);
    EXPECT_NEAR(found.N / truth.N, 1.0, 0.03);
  }
}

TEST(BaseModel, AOneModeRigAgainstOneModeIsNotAccused) {
  const Diagnosis diagnosis = DiagnoseAgainst({.modes = 1}, OneModeRig());
  EXPECT_EQ(diagnosis.kind, VerdictKind::kNone) << diagnosis.effect;
  EXPECT_TRUE(std::ranges::none_of(diagnosis.candidates, [](const Candidate& candidate) {
    return candidate.effect == "mode_detuning";
  }));
}

TEST(LongBaseModel, AnEffectOnTopOfOneModeIsNamed) {
  const EffectPointer effect = QSensorLowPass()[0];
  const std::vector<double> cutoff_hz = {245.0};
  const Diagnosis diagnosis = DiagnoseAgainst(
      {.modes = 1}, OneModeRig([&](RigParameters* rig) { effect->AddTo({}, cutoff_hz, rig); }));
  EXPECT_EQ(diagnosis.effect, "q_sensor_lowpass");
  ASSERT_FALSE(diagnosis.candidates.empty());
  EXPECT_NEAR(diagnosis.candidates[0].parameters[0].value, 245.0, 10.0);
}

// What one mode lacks is one more, at three times the first's frequency.
TEST(LongBaseModel, ATwoModeRigAgainstOneModeHasAModeTooMany) {
  const Diagnosis diagnosis = DiagnoseAgainst({.modes = 1}, SimulateRig());
  EXPECT_EQ(diagnosis.effect, "extra_acoustic_mode");
  ASSERT_FALSE(diagnosis.candidates.empty());
  EXPECT_NEAR(diagnosis.candidates[0].parameters[0].value, 3.0, 0.1);
}

TEST(BaseModel, RecordsTellOneModeFromTwo) {
  const ModesChoice one = ChooseModes(OneModeRig(), {});
  EXPECT_EQ(one.modes, 1);
  EXPECT_LT(one.second_mode_gain, 5.0);
  const ModesChoice two = ChooseModes(SimulateRig(), {.modes = 1});
  EXPECT_EQ(two.modes, 2);
  EXPECT_GT(two.second_mode_gain, 100.0);
}

// A second mode that is stronger than the first has the cycle; the first is far below it then.
TEST(BaseModel, TheFirstModeIsFoundBelowACycleOfTheSecond) {
  const double omega_hz = 288.0;
  const std::vector<DiagnosisExperiment> rig = SimulatePoints(
      2,
      [&](RigParameters* point) {
        point->model.loop = {{omega_hz, 0.1, 500.0, 1700.0, 3.0}, 0.00243};
        point->model.flame.slope = -5e-4;
      },
      23);
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  ASSERT_GT(records[0].at.cycle_frequency_hz, 700.0);
  for (const ExperimentFit& at : FitBase(records).experiments) {
    const Acoustics<double> found = ToAcoustics({}, at.acoustics);
    EXPECT_NEAR(found.omega_hz / omega_hz, 1.0, 0.02);
    EXPECT_NEAR(found.N / 500.0, 1.0, 0.1);
  }
}

TEST(LongBaseModel, TheConfigsRatioIsTheBases) {
  const std::vector<DiagnosisExperiment> rig = OtherRatioRig();
  const Diagnosis right = DiagnoseAgainst({.modes = 2, .harmonic_ratio = kOtherRatio}, rig);
  EXPECT_EQ(right.kind, VerdictKind::kNone) << right.effect;
  const Diagnosis wrong = DiagnoseAgainst({}, rig);
  EXPECT_EQ(wrong.effect, "mode_detuning");
  ASSERT_FALSE(wrong.candidates.empty());
  EXPECT_NEAR(wrong.candidates[0].parameters[0].value, kOtherRatio, 0.03);
}

TEST(BaseModel, TheRatioIsTheNullOfItsDetuning) {
  const BaseModel model{.modes = 2, .harmonic_ratio = kOtherRatio};
  const CutRecord record = MakeCutRecords({SimulateRig()[0]}, model)[0];
  const AcousticLocals locals(std::log(206.0), std::log(0.17), 6400.0, 1700.0);
  const EffectPointer detuning = ModeDetuning({.harmonic_ratio = kOtherRatio})[0];
  EXPECT_TRUE(AcousticResidual(record, *detuning, NullValues(*detuning), locals) ==
              AcousticResidual(record, *BaseEffect(), {}, locals));
}

}  // namespace
}  // namespace howl::base_model_test
