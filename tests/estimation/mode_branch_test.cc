// Two modes on the published experiments: which branch the fit is on, and what the other costs.
#include "estimation/fit/mode_branch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "estimation/fit/loop_crossings.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::mode_branch_test {
namespace {

constexpr std::uint64_t kSeed = 1;

ModelSpec TwoModes() {
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  return model;
}

double Share(const LoopModel& m, double f) {
  const reference::Model first{m.omega_hz, m.xi, m.N, 0, m.tau_s, m.harmonic_ratio};
  const reference::Model second{m.omega_hz, m.xi, 0, m.M, m.tau_s, m.harmonic_ratio};
  return static_cast<double>(std::abs(reference::G(second, f)) / std::abs(reference::G(first, f)));
}

TEST(ModeBranch, TheSecondModeIsMinorByDefault) {
  const ResidualSet residuals = DefaultResidualSet();
  const JointProblem problem(R228(), TwoModes(), residuals);
  const JointFit fit = SolveJoint(problem, {}, kSeed, 2);
  ASSERT_TRUE(fit.converged);
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    const double f = problem.experiments()[i].frequency_hz;
    EXPECT_LT(Share(fit.models[i], f), 1.2 * kSecondModeShareMax) << i;
    EXPECT_GT(fit.models[i].omega_hz, 0.9 * f) << i;
  }
}

TEST(ModeBranch, TheOtherBranchIsFoundWithItsCost) {
  const ResidualSet residuals = DefaultResidualSet();
  const JointProblem problem(R228(), TwoModes(), residuals);
  const JointFit fit = SolveJoint(problem, {}, kSeed, 2);
  const BranchComparison held = CompareBranches(problem, residuals, fit, {}, kSeed, 2);
  ASSERT_TRUE(held.other.has_value());
  EXPECT_GT(held.other->share, 0.5);
  EXPECT_LT(held.other->models[0].omega_hz, 0.85 * 219.9);

  // From the other side: without the residual the fit is over there, at the cost that was said, and
  // the paper's branch is the one that is found.
  ResidualSet without = residuals;
  without[ResidualKind::kSecondModeMinor].enabled = false;
  const JointProblem free(R228(), TwoModes(), without);
  const JointFit lost = SolveJoint(free, {}, kSeed, 2);
  const BranchComparison away = CompareBranches(free, without, lost, {}, kSeed, 2);
  EXPECT_FALSE(away.fit.IsPapers(away.share_max));
  EXPECT_NEAR(away.fit.cost, lost.cost, 1e-9 * lost.cost);
  EXPECT_NEAR(away.fit.cost, held.other->cost, 1e-3 * held.other->cost);
  EXPECT_TRUE(held.DataPreferOther());
  ASSERT_TRUE(away.other.has_value());
  EXPECT_NEAR(away.other->cost, held.fit.cost, 1e-3 * held.fit.cost);
  EXPECT_FALSE(away.DataPreferOther());
}

// Truth by the reference's loop: at a crossing L is real and negative, and what is said of the
// observed frequencies is the loop's there.
TEST(LoopCrossings, LieWhereTheLoopIsRealAndNegative) {
  std::vector<Experiment> experiments = R228();
  experiments[0].lines = {{750.0, 10.0}};
  // The paper's section 4, figure 12: 215 Hz and 746 Hz.
  const LoopModel model{
      .omega_hz = 215.0, .xi = 0.2, .N = 6609.0, .M = 0.75 * 6609.0, .tau_s = 3.46e-3};
  const auto crossings = LoopCrossings(experiments[0], model, TwoModes());
  ASSERT_GE(crossings.size(), 2u);
  int observed = 0;
  for (const ObservedCrossing& one : crossings) {
    const auto l = reference::L(reference::From(model), one.crossing.frequency_hz) * 0.703e-4L;
    EXPECT_NEAR(static_cast<double>(l.real()), -one.crossing.gain, 1e-6);
    EXPECT_NEAR(static_cast<double>(l.imag()), 0.0, 1e-6);
    if (!one.observed_hz) continue;
    ++observed;
    const auto there = -reference::L(reference::From(model), *one.observed_hz) * 0.703e-4L;
    EXPECT_NEAR(one.observed_gain, static_cast<double>(std::abs(there)), 1e-9);
    EXPECT_NEAR(one.phase_error_deg, static_cast<double>(reference::Deg(there)), 1e-9);
  }
  EXPECT_EQ(observed, 2);
  EXPECT_NEAR(crossings.front().crossing.frequency_hz, 217.0, 5.0);
  EXPECT_EQ(crossings.front().observed_hz, 219.9);
  // Without a slope there is no gain.
  experiments[0].flame_slope.reset();
  for (const ObservedCrossing& one : LoopCrossings(experiments[0], model, TwoModes())) {
    EXPECT_TRUE(std::isnan(one.crossing.gain));
  }
}

}  // namespace
}  // namespace howl::mode_branch_test
