// The joint likelihood of both cuts, its score, and what a fit by it finds in simulated rigs.
#include "diagnosis/structure/structure_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/structure/point_scoring.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl {
namespace {

constexpr double kTau_s = 0.00352;
const std::vector<double> kDelayFactors = {0.97, 1.0, 1.02};

std::vector<DiagnosisExperiment> RigOfOwnDelays(std::uint64_t seed) {
  std::size_t point = 0;
  return SimulatePoints(
      3, [&](RigParameters* rig) { rig->model.loop.tau_s = kTau_s * kDelayFactors[point++]; },
      seed);
}

struct Prepared {
  std::vector<JointBand> bands;
  StructureFit start;
};

Prepared Prepare(const std::vector<DiagnosisExperiment>& rig) {
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  Prepared out;
  for (const CutRecord& record : records) out.bands.push_back(MakeJointBand(record));
  out.start = StartOf(&out.bands, FitBase(records), BaseNoise());
  out.start.structure.own_delays = true;
  out.start.shared.delay_scatter = 0.02;
  return out;
}

// Every number that ScorePoint has a gradient for, moved by `step`, in the same order.
void Move(const PointLayout& layout, Eigen::Index k, double step, SharedLoop* shared,
          PointLoop* point) {
  if (k < layout.Own()) {
    MoveOwn(layout, k, step, point);
    return;
  }
  k -= layout.Own();
  if (k == 0) shared->tau_s *= std::exp(step);
  if (k == 1) shared->values[0] *= std::exp(step);
  if (k == 2) shared->eps_a *= std::exp(step);
  if (k == 3) shared->eps_b *= std::exp(step);
}

TEST(JointLikelihood, ScoreIsTheLikelihoodsGradient) {
  Prepared at = Prepare(RigOfOwnDelays(11));
  at.start.structure.noise.push_back({LoopNoise::kDuct, 2});
  const EffectPointer effect = QSensorLowPass()[0];
  at.start.shared.values = {900.0};
  PointLoop point = at.start.points[1];
  point.noise.push_back(Eigen::Vector2d(point.noise[0][0] - 1.0, 0.3));
  PointLoop centre = point;
  centre.acoustics[1] += 0.1;  // so that the priors have a slope too
  const std::vector<NoiseTerm>& noise = at.start.structure.noise;
  at.start.structure.effects = {effect};
  at.start.structure.complex_residues = true;
  at.start.structure.further_modes = 1;
  point.base_b = Eigen::Vector2d(0.1, -0.05);
  point.modes = {Eigen::Vector4d(std::log(370.0), std::log(0.04), 0.2, 0.1)};
  const PointLayout layout = LayoutOf(at.start.structure, at.bands[1].record.model);
  const PointScore score =
      ScorePoint(layout, at.bands[1], *effect, noise, at.start.shared, point, centre,
                 MakeJointResiduals(at.bands[1], *effect, at.start.shared, point));
  ASSERT_EQ(score.gradient.size(), layout.Own() + 4);
  const auto value = [&](Eigen::Index k, double step) {
    SharedLoop shared = at.start.shared;
    PointLoop moved = point;
    Move(layout, k, step, &shared, &moved);
    const JointResiduals residuals = MakeJointResiduals(at.bands[1], *effect, shared, moved);
    return Evaluate(at.bands[1], noise, shared, moved, residuals).log_likelihood +
           PointPrior(layout, at.bands[1], moved, centre, shared.delay_scatter);
  };
  constexpr double kStep = 1e-4;
  for (Eigen::Index k = 0; k < score.gradient.size(); ++k) {
    const double numeric = (value(k, kStep) - value(k, -kStep)) / (2.0 * kStep);
    // One standard deviation of the score, by the information, is its natural unit.
    const double unit = std::sqrt(score.information(k, k));
    EXPECT_NEAR(score.gradient[k], numeric, 0.01 * unit + 2e-3 * std::abs(numeric)) << "of " << k;
  }
}

TEST(StructureFit, FindsDelaysAndModesWithinTheirErrors) {
  const Prepared at = Prepare(RigOfOwnDelays(5));
  const StructureFit fit = FitStructure(at.bands, at.start);
  for (std::size_t e = 0; e < at.bands.size(); ++e) {
    const double tau_s = fit.shared.tau_s * std::exp(fit.points[e].log_delay);
    EXPECT_NEAR(tau_s, kTau_s * kDelayFactors[e], 0.003 * kTau_s) << e;
    const auto& acoustics = TestRig(static_cast<int>(e)).model.loop.acoustics;
    EXPECT_NEAR(std::exp(fit.points[e].acoustics[0]), acoustics.omega_hz,
                0.01 * acoustics.omega_hz);
    EXPECT_NEAR(fit.points[e].acoustics[2], acoustics.N, 0.05 * acoustics.N) << e;
  }
  // The model is right: there is no error to be seen.
  EXPECT_LT(fit.shared.eps_a, 0.01);
  EXPECT_LT(fit.shared.eps_b, 0.01);
}

TEST(StructureFit, EndsHigherThanItBegan) {
  const Prepared at = Prepare(RigOfOwnDelays(7));
  StructureOptions none;
  none.iterations = 0;
  const double before = FitStructure(at.bands, at.start, none).log_posterior;
  EXPECT_GT(FitStructure(at.bands, at.start).log_posterior, before);
}

}  // namespace
}  // namespace howl
