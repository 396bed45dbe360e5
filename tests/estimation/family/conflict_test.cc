#include "estimation/family/answers/conflict/conflict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "estimation/family/bounds/feasible.h"
#include "estimation/family/members/enumerate.h"
#include "tests/r228.h"

namespace howl::conflict_test {
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

std::vector<SmallestChange> Helping(const Conflict& conflict, ChangeKind kind) {
  std::vector<SmallestChange> helping;
  for (const SmallestChange& change : conflict.changes) {
    if (change.helps && change.target.kind == kind) helping.push_back(change);
  }
  return helping;
}

// Each change is the edge: members exist just beyond it, and none just before it.
TEST(ConflictTest, ChangesAreTheEdges) {
  const FamilyProblem problem = Published(0.15, 0.3);
  const Conflict conflict = ExplainEmpty(problem);
  const std::vector<SmallestChange> changes = Helping(conflict, ChangeKind::kCondition);
  ASSERT_EQ(changes.size(), 3u);
  for (const SmallestChange& change : changes) {
    ASSERT_TRUE(change.needed.has_value());
    EXPECT_GT(*change.needed, change.value);
    EXPECT_TRUE(change.less_is_proved_empty);
    const FamilyProblem beyond = Changed(problem, change.target, *change.needed * (1.0 + 1e-3));
    const FamilyProblem before = Changed(problem, change.target, *change.needed * (1.0 - 1e-4));
    EXPECT_EQ(EnumerateMembers(beyond, 20, 1, 1).members.size(), 20u);
    EXPECT_EQ(DecideFeasible(before), Feasibility::kEmpty);
  }
}

TEST(ConflictTest, EveryConditionThatBindsIsAnswered) {
  const Conflict conflict = ExplainEmpty(Published(0.15, 0.3));
  std::vector<Condition> helping;
  std::vector<Condition> helpless;
  for (const SmallestChange& change : conflict.changes) {
    if (change.target.kind != ChangeKind::kCondition) continue;
    (change.helps ? helping : helpless).push_back(change.target.condition);
  }
  EXPECT_THAT(helping, ElementsAre(Condition::kPhase, Condition::kOmegaSpread, Condition::kXiMax));
  EXPECT_THAT(helpless, ElementsAre(Condition::kGain, Condition::kLoopPhase, Condition::kLoopGain,
                                    Condition::kXiIncreasing));
}

TEST(ConflictTest, GainsThatExcludeEachOtherAreNamedAlone) {
  FamilyProblem problem = Published(0.25, 0.3);
  problem.test.loop_gain_min = 1.2;  // exp1 has 1.179 in table 3, the others more
  const Conflict conflict = ExplainEmpty(problem);
  ASSERT_EQ(conflict.minimal_sets.size(), 1u);
  EXPECT_THAT(conflict.minimal_sets[0], ElementsAre(Condition::kGain, Condition::kLoopGain));
  const std::vector<SmallestChange> limits = Helping(conflict, ChangeKind::kCondition);
  ASSERT_EQ(limits.size(), 2u);
  // |L Phi'(0)| of exp1 at one per cent more gain.
  const double gain = 2 * M_PI * 219.9 * 12.14 * 0.703e-4;
  EXPECT_NEAR(*limits[0].needed, 1.2 / gain - 1.0, 1e-9);
  EXPECT_NEAR(*limits[1].needed, 1.01 * gain, 1e-6);
  // The same by each datum of that experiment that enters it, and by none of another.
  for (const SmallestChange& change : Helping(conflict, ChangeKind::kDatum)) {
    EXPECT_EQ(change.target.experiment, 0u);
    if (change.target.datum == Datum::kGain || change.target.datum == Datum::kFlameSlope) {
      EXPECT_NEAR(*change.needed / change.value, 1.2 / (1.01 * gain), 1e-4);
    }
  }
  EXPECT_EQ(Helping(conflict, ChangeKind::kDatum).size(), 4u);  // f, gain, slope, reliable
}

// A delay that the loop phase excludes is bounds against bounds: intervals prove it at once.
TEST(ConflictTest, DisjointBoundsAreAProof) {
  for (const int modes : {1, 2}) {
    SCOPED_TRACE(modes);
    FamilyProblem problem = Published(0.25, 0.3);
    problem.model.modes = modes;
    problem.domain[ParameterKind::kTau] = {0.006, 0.007};  // of 3.3 to 3.5 ms
    const Conflict conflict = ExplainEmpty(problem);
    ASSERT_TRUE(conflict.is_empty);
    EXPECT_TRUE(conflict.proved);
    for (const bool proved : conflict.sets_proved) EXPECT_TRUE(proved);
    const std::vector<SmallestChange> bounds = Helping(conflict, ChangeKind::kBound);
    ASSERT_EQ(bounds.size(), 1u);
    EXPECT_FALSE(bounds[0].target.is_upper);
    // The largest delay that exp1, the shortest of all, is left by both tolerances.
    EXPECT_NEAR(*bounds[0].needed, (270 - 5.74 + 0.5 + 1.0) / 360 / 219.9, 3e-6);
  }
}

TEST(ConflictTest, DisjointBoundsOfTwoParametersAreAProof) {
  FamilyProblem problem = Published(0.25, 0.3);
  // p lags q: omega lies below the cycle's frequency, by more than this with that damping.
  problem.domain[ParameterKind::kOmega].lo = 219.0;
  problem.domain[ParameterKind::kXi].lo = 0.1;
  const Conflict conflict = ExplainEmpty(problem);
  ASSERT_TRUE(conflict.is_empty);
  EXPECT_TRUE(conflict.proved);
  for (const bool proved : conflict.sets_proved) EXPECT_TRUE(proved);
}

}  // namespace
}  // namespace howl::conflict_test
