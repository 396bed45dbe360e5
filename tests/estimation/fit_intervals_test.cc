// The intervals of a joint fit on records: they hold the truth, and agree with the transfer's own.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/estimation/fit_rows.h"

namespace howl::fit_intervals_test {
namespace {

// Twenty draws of the noise for each rig. With the level of q's noise a doubt of every point by
// itself, half of these intervals held: N and xi came out 2 to 3 standard deviations too large.
TEST(LongFitIntervals, HoldTheTruthOfSimulatedRigs) {
  constexpr int kDraws = 20;
  int count = 0, covered = 0;
  for (const fixtures::StudiedRig& rig : fixtures::StudiedRigs()) {
    const fixtures::FitStudy study = fixtures::StudyFits(rig, kDraws, 5, 0.001, 0.001);
    EXPECT_EQ(study.not_converged, 0) << rig.name;
    const fixtures::FitScore all = fixtures::FitStudy::All(study.fit);
    count += all.count;
    covered += all.covered;
    // The truth's square distance over its degrees of freedom is one on average, and no true model
    // may fail the family's test.
    EXPECT_LT(study.square_distance, 1.3 * study.ellipsoids) << rig.name;
    EXPECT_EQ(study.beyond_default, 0) << rig.name;
    for (const auto& [name, score] : study.fit) {
      // At most five of twenty outside: 3e-4 by chance.
      EXPECT_GE(score.covered, kDraws - 5) << rig.name << ' ' << name;
    }
  }
  EXPECT_GT(count, 500);
  EXPECT_GE(covered, 0.94 * count);
}

// One experiment whose transfer alone tells N: a doubt of 3 % in the level of q's noise is one for
// all points, and stays however many there are.
TEST(FitIntervals, DoubtOfTheNoiseFloorDoesNotAverageOut) {
  ResidualSet residuals = DefaultResidualSet();
  for (ResidualSpec& spec : residuals.specs) spec.enabled = false;
  residuals[ResidualKind::kTransfer].enabled = true;
  ModelSpec model = DefaultModelSpec();
  model[ParameterKind::kTau].fixed = true;
  const Acoustics<double> truth{204.0, 0.15, 5500.0, 0.0, kPaperHarmonicRatio};
  for (const double step_hz : {20.0, 1.0}) {
    Experiment experiment;
    experiment.name = "exp1";
    experiment.frequency_hz = 210.0;
    experiment.phase_deg = -10.0;
    experiment.gain = 14.0;
    for (double f = 60.0; f < 400.0; f += step_hz) {
      const Complex<double> g = AcousticResponse(truth, f);
      TransferPoint point;
      point.frequency_hz = f;
      point.re = g.re;
      point.im = g.im;
      point.variance_re = point.variance_im = 1e-4 * SquaredMagnitude(g);
      point.q_noise_bias = 0.03;
      experiment.transfer.push_back(point);
    }
    const JointFit fit = SolveJoint(JointProblem({experiment}, model, residuals), {}, 1, 1);
    ASSERT_TRUE(fit.converged) << fit.termination;
    for (const FitParameter& parameter : fit.parameters) {
      EXPECT_NE(parameter.name, "exp1.q_noise") << "no parameter of a model";
      if (parameter.name != "exp1.N") continue;
      EXPECT_NEAR(parameter.value, truth.N, 0.01 * truth.N);
      EXPECT_GT(parameter.std_relative, 0.03 * kQNoiseLevelStd) << step_hz;
      EXPECT_LT(parameter.std_relative, 1.4 * 0.03 * kQNoiseLevelStd) << step_hz;
    }
    EXPECT_EQ(fit.free_names.size(), 3u);
  }
}

}  // namespace
}  // namespace howl::fit_intervals_test
