// What a joint fit says of itself: bounds, guard rails, residuals.
#include "estimation/health/fit_health.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/estimation/health/right_rig.h"
#include "tests/r228.h"

namespace howl::fit_health_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::IsEmpty;

// One row of a table whose p comes from an inverted transducer.
Experiment InvertedRow() {
  return {.name = "exp1",
          .phi = 0.56,
          .frequency_hz = 200.0,
          .phase_deg = 170.0,
          .gain = 12.0,
          .flame_slope = -0.7e-4};
}

TEST(FitHealth, NothingIsFoundInTheRightTable) {
  const JointProblem problem(R228(), DefaultModelSpec(), DefaultResidualSet());
  EXPECT_THAT(CheckFit(problem, SolveJoint(problem, {}, 1, 2)), IsEmpty());
}

TEST(FitHealth, AParameterOnAGuardRailIsNoFit) {
  const JointProblem problem({InvertedRow()}, DefaultModelSpec(), DefaultResidualSet());
  const JointFit fit = SolveJoint(problem, {}, 1, 2);
  EXPECT_FALSE(fit.converged);
  EXPECT_THAT(fit.termination, testing::StartsWith("GUARD_RAIL: "));
  const Health health = CheckFit(problem, fit);
  EXPECT_THAT(health, Contains(Field(&Finding::kind, FindingKind::kGuardRail)));
  EXPECT_THAT(health, Contains(AllOf(Field(&Finding::kind, FindingKind::kResidual),
                                     Field(&Finding::subject, "phase_equality exp1"))));
}

TEST(FitHealth, ABoundOfTheConfigIsSaidAndIsAFit) {
  ModelSpec model = DefaultModelSpec();
  // Exp1's damping is 0.15 without the bound (README).
  model[ParameterKind::kXi].max = 0.12;
  const JointProblem problem(R228(), model, DefaultResidualSet());
  const JointFit fit = SolveJoint(problem, {}, 1, 2);
  EXPECT_TRUE(fit.converged) << fit.termination;
  const Health health = CheckFit(problem, fit);
  EXPECT_THAT(health, Contains(AllOf(Field(&Finding::kind, FindingKind::kBound),
                                     Field(&Finding::subject, "exp1.xi"),
                                     Field(&Finding::limit, testing::DoubleNear(0.12, 1e-9)))));
}

TEST(FitHealth, AVanishingSecondModeIsTheOneModeModel) {
  // Data of one mode: the second one's size falls to the least that its logarithm can have.
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  ResidualSet residuals = DefaultResidualSet();
  JointProblem problem(RightTable(0), model, residuals);
  JointFit fit = SolveJoint(problem, {}, 1, 2);
  for (FitParameter& parameter : fit.parameters) {
    EXPECT_FALSE(parameter.at_guard_rail) << parameter.name << " " << parameter.value;
  }
  EXPECT_TRUE(fit.converged) << fit.termination;
}

TEST(FitHealth, AResidualCountsByItsWeight) {
  std::vector<Experiment> table = R228();
  // Seven default standard deviations off; half of that with a quarter of the weight.
  table[5].gain_std = 1e-6 * table[5].gain;
  JointProblem problem(table, DefaultModelSpec(), DefaultResidualSet());
  JointFit fit = SolveJoint(problem, {}, 1, 2);
  const auto phase = std::ranges::find(fit.residuals, "phase_equality exp6", &FitResidual::label);
  ASSERT_NE(phase, fit.residuals.end());
  phase->values = {7.0};
  const Health health = CheckFit(problem, fit);
  EXPECT_THAT(health, Contains(AllOf(Field(&Finding::subject, "phase_equality exp6"),
                                     Field(&Finding::value, testing::DoubleNear(3.5, 1e-12)))));
  phase->values = {5.0};
  EXPECT_THAT(CheckFit(problem, fit),
              Each(Field(&Finding::subject, testing::Ne("phase_equality exp6"))));
}

}  // namespace
}  // namespace howl::fit_health_test
