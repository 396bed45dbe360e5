// Verdicts on simulated rigs whose make is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/numerics/scaled_solve.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::diagnosis_test {
namespace {

const std::vector<DiagnosisExperiment>& CleanRig() {
  static const std::vector<DiagnosisExperiment> rig = SimulateRig();
  return rig;
}

const Candidate& CandidateOf(const Diagnosis& diagnosis, const std::string& id) {
  return *std::find_if(diagnosis.candidates.begin(), diagnosis.candidates.end(),
                       [&](const Candidate& c) { return c.effect == id; });
}

TEST(BaseFit, RecoversTheRig) {
  const std::vector<CutRecord> records = MakeCutRecords(CleanRig());
  const EffectFit fit = FitBase(records);
  EXPECT_NEAR(fit.tau_s, 0.00352, 5.0 * fit.standard_errors[0] + 1e-6);
  for (int point = 0; point < 3; ++point) {
    const Acoustics<double> truth = TestRig(point).model.loop.acoustics;
    const Acoustics<double> found =
        ToAcoustics({}, fit.experiments[static_cast<std::size_t>(point)].acoustics);
    EXPECT_NEAR(found.omega_hz / truth.omega_hz, 1.0, 2e-3);
    EXPECT_NEAR(found.xi / truth.xi, 1.0, 0.03);
    EXPECT_NEAR(found.N / truth.N, 1.0, 0.03);
    EXPECT_NEAR(found.M / truth.M, 1.0, 0.06);
  }
}

// Of one experiment no other tells what the parameters are: what is left is its own fit, and not
// the square of a number that is none.
TEST(HeldOut, OfALoneExperimentIsItsOwnFit) {
  const std::vector<CutRecord> records = MakeCutRecords({CleanRig()[0]});
  const EffectFit fit = FitBase(records);
  const ExperimentFit held_out = HeldOut(records, fit, 0);
  ASSERT_TRUE(held_out.flame_residual.allFinite());
  EXPECT_NEAR(held_out.flame_residual.norm() / fit.experiments[0].flame_residual.norm(), 1.0, 0.02);
  EXPECT_NEAR(held_out.acoustic_residual.norm() / fit.experiments[0].acoustic_residual.norm(), 1.0,
              0.02);
}

TEST(ScaledSolve, AnUnknownWithoutCurvatureIsZero) {
  const Eigen::MatrixXd h = Eigen::Vector3d(4.0, 0.0, 9e-40).asDiagonal();
  const Eigen::VectorXd x = SolveScaled(h, Eigen::Vector3d(8.0, 5.0, 9e-40), 0.0);
  EXPECT_NEAR(x[0], 2.0, 1e-12);
  EXPECT_EQ(x[1], 0.0);
  EXPECT_NEAR(x[2], 1.0, 1e-12);
}

TEST(Effects, NullResidualsAreTheBasesBitForBit) {
  const std::vector<CutRecord> records = MakeCutRecords({CleanRig()[0]});
  const CutRecord& record = records[0];
  const EffectPointer base = BaseEffect();
  const AcousticLocals locals(std::log(206.0), std::log(0.17), 6400.0, 1700.0);
  const double tau = 0.00352;
  const Eigen::VectorXcd acoustic = AcousticResidual(record, *base, {}, locals);
  const FlameColumns columns = MakeFlameColumns(record, *base, {}, tau);
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(record.flame_count);
  const Eigen::VectorXcd flame = SolveFlame(record, *base, {}, tau, columns, weight).residual;
  for (const EffectPointer& effect : Catalogue()) {
    const std::vector<double> x = NullValues(*effect);
    EXPECT_TRUE(AcousticResidual(record, *effect, x, locals) == acoustic) << effect->id();
    const FlameColumns own = MakeFlameColumns(record, *effect, x, tau);
    EXPECT_TRUE(SolveFlame(record, *effect, x, tau, own, weight).residual == flame) << effect->id();
  }
}

TEST(Diagnose, CleanRigIsNotAccused) {
  const Diagnosis diagnosis = Diagnose(CleanRig(), {});
  EXPECT_EQ(diagnosis.kind, VerdictKind::kNone) << diagnosis.effect;
  EXPECT_LT(diagnosis.gap_before, 2.0 * diagnosis.gap_floor);
  double total = diagnosis.probability_none + diagnosis.probability_unknown;
  for (const Candidate& candidate : diagnosis.candidates) total += candidate.probability;
  EXPECT_NEAR(total, 1.0, 1e-9);
}

TEST(LongDiagnose, NamesALowPassOnQAndItsCutOff) {
  const std::vector<DiagnosisExperiment> rig =
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)});
  DiagnosisOptions options;
  const Diagnosis diagnosis = Diagnose(rig, options);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "q_sensor_lowpass");
  EXPECT_EQ(diagnosis.where.at(0).block, LoopBlock::kHeatReleaseInstrument);
  EXPECT_NEAR(CandidateOf(diagnosis, "q_sensor_lowpass").parameters[0].value, 400.0, 12.0);
  EXPECT_GT(CandidateOf(diagnosis, "q_sensor_lowpass").shrinkage, 0.8);

  // Withheld, it is not pinned on another.
  options.withheld = {"q_sensor_lowpass"};
  EXPECT_EQ(Diagnose(rig, options).kind, VerdictKind::kUnknown);
}

// Those whose fits take longest.
const std::vector<std::string> kSlow = {"q_sensor_lowpass", "p_sensor_resonance",
                                        "extra_acoustic_mode", "delay_dispersion",
                                        "second_delay_path"};

TEST(Diagnose, TheSameBitsForAnyNumberOfThreads) {
  DiagnosisOptions options;
  options.withheld = kSlow;
  options.threads = 1;
  const Diagnosis one = Diagnose(CleanRig(), options);
  options.threads = 3;
  const Diagnosis three = Diagnose(CleanRig(), options);
  ASSERT_EQ(three.candidates.size(), one.candidates.size());
  for (std::size_t i = 0; i < one.candidates.size(); ++i) {
    EXPECT_EQ(three.candidates[i].effect, one.candidates[i].effect);
    EXPECT_EQ(three.candidates[i].gain, one.candidates[i].gain);
    EXPECT_EQ(three.candidates[i].gap_after, one.candidates[i].gap_after);
    EXPECT_EQ(three.candidates[i].probability, one.candidates[i].probability);
  }
}

TEST(LongDiagnose, TellsHumInPFromATone) {
  std::vector<DiagnosisExperiment> rig = CleanRig();
  for (DiagnosisExperiment& experiment : rig) {
    for (std::size_t i = 0; i < experiment.record.pressure.size(); ++i) {
      const double t = static_cast<double>(i) / experiment.record.sampling_hz;
      experiment.record.pressure[i] += 0.3 * std::sin(2.0 * std::numbers::pi * 50.0 * t + 0.3);
    }
  }
  DiagnosisOptions options;
  options.withheld = kSlow;
  const Diagnosis diagnosis = Diagnose(rig, options);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "mains_hum");
  EXPECT_EQ(diagnosis.where.at(0).block, LoopBlock::kPressureInstrument);
}

}  // namespace
}  // namespace howl::diagnosis_test
