#include "estimation/family/conflict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimation/family/enumerate.h"
#include "estimation/family/feasible.h"
#include "tests/r228.h"

namespace howl {
namespace {

using ::testing::ElementsAre;

FamilyProblem Published(double spread, double xi_max) {
  FamilyProblem problem{.experiments = R228()};
  problem.test.omega_spread_max = spread;
  problem.test.xi_max = xi_max;
  return problem;
}

TEST(ConflictTest, PublishedTableAtNarrowSpreadIsEmptyAndSaysWhy) {
  const FamilyProblem problem = Published(0.15, 0.3);
  EXPECT_TRUE(EnumerateMembers(problem, 100, 1, 1).members.empty());
  const Conflict conflict = ExplainEmpty(problem);
  ASSERT_TRUE(conflict.is_empty);
  EXPECT_TRUE(conflict.proved);
  ASSERT_FALSE(conflict.minimal_sets.empty());
  EXPECT_THAT(conflict.minimal_sets[0],
              ElementsAre(Condition::kPhase, Condition::kOmegaSpread, Condition::kXiMax));
  EXPECT_THAT(ConflictNames(conflict),
              ElementsAre("phase_tolerance_deg", "omega_spread_max", "xi_max"));
}

TEST(ConflictTest, PublishedTableAtWideSpreadHasMembers) {
  const FamilyProblem problem = Published(0.25, 0.3);
  EXPECT_FALSE(ExplainEmpty(problem).is_empty);
  EXPECT_EQ(EnumerateMembers(problem, 100, 1, 1).members.size(), 100u);
}

// Each relaxation is the edge: members exist just beyond it, and none just before it.
TEST(ConflictTest, RelaxationsAreTheEdges) {
  const FamilyProblem problem = Published(0.15, 0.3);
  const Conflict conflict = ExplainEmpty(problem);
  ASSERT_EQ(conflict.relaxations.size(), 3u);
  for (const Relaxation& relaxation : conflict.relaxations) {
    ASSERT_TRUE(relaxation.suffices);
    ASSERT_TRUE(relaxation.needed.has_value());
    EXPECT_GT(*relaxation.needed, relaxation.value);
    FamilyProblem beyond = problem;
    FamilyProblem before = problem;
    const auto set = [&](MembershipTest& test, double value) {
      if (relaxation.condition == Condition::kPhase) test.phase_tolerance_deg = value;
      if (relaxation.condition == Condition::kOmegaSpread) test.omega_spread_max = value;
      if (relaxation.condition == Condition::kXiMax) test.xi_max = value;
    };
    set(beyond.test, *relaxation.needed * (1.0 + 1e-3));
    set(before.test, *relaxation.needed * (1.0 - 1e-4));
    EXPECT_EQ(EnumerateMembers(beyond, 20, 1, 1).members.size(), 20u);
    EXPECT_EQ(DecideFeasible(before), Feasibility::kEmpty);
  }
}

TEST(ConflictTest, GainsThatExcludeEachOtherAreNamedAlone) {
  FamilyProblem problem = Published(0.25, 0.3);
  problem.test.loop_gain_min = 1.25;  // exp1 has 1.179, exp2 1.221
  const Conflict conflict = ExplainEmpty(problem);
  ASSERT_EQ(conflict.minimal_sets.size(), 1u);
  EXPECT_THAT(conflict.minimal_sets[0], ElementsAre(Condition::kGain, Condition::kLoopGain));
  ASSERT_EQ(conflict.relaxations.size(), 2u);
  // |L Phi'(0)| of exp1 at one per cent more gain.
  EXPECT_NEAR(*conflict.relaxations[1].needed, 1.01 * 1.1792, 1e-3);
}

}  // namespace
}  // namespace howl
