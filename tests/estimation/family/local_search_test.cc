// Local searches and the profiles made of them, against closed forms of one experiment with one
// mode.
#include "estimation/family/local/local_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimation/family/answers/family_profile.h"
#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/enumerate.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::local_search_test {
namespace {

constexpr double kRad = M_PI / 180;

FamilyProblem One() {
  FamilyProblem problem{.experiments = R228()};
  problem.experiments.resize(1);
  return problem;
}

MemberQuantity Quantity(const FamilyProblem& problem, const std::string& text) {
  ExpressionError error;
  const auto quantity = ParseQuantity(text, problem, error);
  EXPECT_TRUE(quantity.has_value()) << error.message;
  return *quantity;
}

Member AnyMember(const FamilyProblem& problem) {
  return EnumerateMembers(problem, 1, 1, 1).members.at(0);
}

TEST(LocalSearchTest, ReachesTheClosedFormsExtremes) {
  const FamilyProblem problem = One();
  const Experiment& e = problem.experiments[0];
  const LocalSearch search(problem);
  const Member start = AnyMember(problem);
  const double w = 2 * M_PI * e.frequency_hz;
  const double t = std::tan(6.24 * kRad);
  const double omega = e.frequency_hz * (std::sqrt(0.09 * t * t + 1) - 0.3 * t);
  const auto far = [&](const char* text, double sign, double scale) {
    const MemberQuantity quantity = Quantity(problem, text);
    const auto member = search.Farthest(start, quantity, sign, scale);
    EXPECT_TRUE(member.has_value()) << text;
    EXPECT_TRUE(reference::Passes(problem.experiments, *member, problem.test)) << text;
    return quantity.value(*member);
  };
  EXPECT_NEAR(far("exp1.omega_hz", -1.0, 7.0), omega, 7e-4);
  EXPECT_NEAR(far("exp1.xi", 1.0, 0.3), 0.3, 3e-5);
  EXPECT_NEAR(far("exp1.tau_s", 1.0, 3e-5), (270 - 5.24 + 1) * kRad / w, 3e-9);
  EXPECT_NEAR(far("exp1.tau_s", -1.0, 3e-5), (270 - 6.24 - 1) * kRad / w, 3e-9);
  EXPECT_NEAR(far("exp1.loop_gain", 1.0, 0.02), 1.01 * e.gain * w * 0.703e-4, 2e-6);
}

// From far outside, with two modes and six experiments.
TEST(LocalSearchTest, FindsAMemberFromAModelThatFailsEverything) {
  FamilyProblem problem{.experiments = R228()};
  problem.model.modes = 2;
  problem.domain[ParameterKind::kXi].lo = 0.02;
  const LocalSearch search(problem);
  FamilyProblem loose = problem;
  loose.test = {0.5, 30.0, 60.0, 0.0, 90.0, 1.5, 1.0, false};
  for (const Member& start : EnumerateMembers(loose, 10, 3, 1).members) {
    ASSERT_FALSE(Falsify(problem.experiments, start, problem.test).IsEmpty());
    const auto found = search.ReduceViolation(start);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(found->violation, 1.0);
    EXPECT_TRUE(reference::Passes(problem.experiments, found->member, problem.test));
  }
}

TEST(LocalSearchTest, EmptyFamilyLeavesAViolation) {
  FamilyProblem problem{.experiments = R228()};
  const Member start = AnyMember(problem);
  problem.test.omega_spread_max = 0.15;  // 0.18357 is the least with xi_max 0.3
  const auto nearest = LocalSearch(problem).ReduceViolation(start, 0.0);
  ASSERT_TRUE(nearest.has_value());
  EXPECT_GT(nearest->violation, 1.0);
}

TEST(LocalSearchTest, ASharedDampingIsNotSearched) {
  FamilyProblem problem{.experiments = R228()};
  problem.model[ParameterKind::kXi].scope = ParameterScope::kShared;
  EXPECT_FALSE(LocalSearch(problem).IsSupported());
}

// With errors of phase within half a degree and of loop phase within one, an experiment allows
// w tau = 270 degrees + phase +- 1.5 degrees; a shared delay lies in both intervals.
TEST(LocalSearchTest, ASharedDelayReachesBothExperimentsExtremes) {
  FamilyProblem problem{.experiments = R228()};
  problem.experiments = {problem.experiments[2], problem.experiments[3]};
  problem.model[ParameterKind::kTau].scope = ParameterScope::kShared;
  double lowest = 0.0, highest = INFINITY;
  for (const Experiment& e : problem.experiments) {
    const double w = 2 * M_PI * e.frequency_hz;
    lowest = std::max(lowest, (270 + e.phase_deg - 1.5) * kRad / w);
    highest = std::min(highest, (270 + e.phase_deg + 1.5) * kRad / w);
  }
  const LocalSearch search(problem);
  ASSERT_TRUE(search.IsSupported());
  FamilyProblem loose = problem;
  loose.test = {0.5, 30.0, 60.0, 0.0, 90.0, 1.5, 1.0, false};
  for (const Member& start : EnumerateMembers(loose, 5, 3, 1).members) {
    const auto found = search.ReduceViolation(start);
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(reference::Passes(problem.experiments, found->member, problem.test));
    EXPECT_EQ(found->member[0].tau_s, found->member[1].tau_s);
    const MemberQuantity tau = Quantity(problem, "exp4.tau_s");
    for (const double sign : {-1.0, 1.0}) {
      const auto far = search.Farthest(found->member, tau, sign, 3e-5);
      ASSERT_TRUE(far.has_value());
      EXPECT_TRUE(reference::Passes(problem.experiments, *far, problem.test));
      EXPECT_NEAR(tau.value(*far), sign > 0 ? highest : lowest, 3e-9);
    }
  }
}

// The published two-mode problem of six experiments: every bound meets to one per cent.
TEST(LocalSearchTest, TwoModeBoundsOfSixExperimentsMeet) {
  FamilyProblem problem{.experiments = R228()};
  for (std::size_t i = 0; i < 4; ++i) problem.experiments[i].lines = {{750.0, 10.0}};
  problem.model.modes = 2;
  problem.domain[ParameterKind::kOmega].lo = 150.0;
  problem.domain[ParameterKind::kXi].lo = 0.02;
  problem.domain[ParameterKind::kM].hi = 5000.0;
  problem.test.second_crossing_tolerance_deg = 30.0;
  problem.test.xi_max = 0.4;
  Enclosure enclosure(problem, {.seed = 1, .threads = 2});
  ASSERT_TRUE(enclosure.Run());
  for (std::size_t i = 0; i < 6; ++i) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      const EnclosedBound bound = enclosure.Bound(i, parameter);
      EXPECT_TRUE(bound.closed) << i << " " << FamilyParameterName(parameter);
      EXPECT_LE(bound.Excess(), 0.01) << i << " " << FamilyParameterName(parameter);
    }
  }
  for (const Member& witness : enclosure.Witnesses()) {
    EXPECT_TRUE(reference::Passes(problem.experiments, witness, problem.test, 1e-9L));
  }
}

// w (tau - tau_0) = phase error - loop phase error: shared in the ratio of their tolerances, the
// largest share is |w (tau - tau_0)| / (both tolerances).
TEST(FamilyProfileTest, DelayAgainstTheClosedForm) {
  const FamilyProblem problem = One();
  const Experiment& e = problem.experiments[0];
  const auto profile = ProfileFamily(problem, Quantity(problem, "exp1.tau_s"),
                                     EnumerateMembers(problem, 20, 1, 1).members);
  ASSERT_TRUE(profile.has_value());
  EXPECT_TRUE(profile->IsSound());
  const double w = 2 * M_PI * e.frequency_hz;
  const double tau_0 = (270 + e.phase_deg) * kRad / w;
  ASSERT_GT(profile->points.size(), 10u);
  for (const ProfilePoint& point : profile->points) {
    EXPECT_NEAR(point.cost, std::abs(w * (point.value - tau_0)) / (1.5 * kRad), 1e-4)
        << point.value;
  }
  EXPECT_NEAR(profile->lo, tau_0 - 1.5 * kRad / w, 1e-3 * kRad / w);
  EXPECT_NEAR(profile->hi, tau_0 + 1.5 * kRad / w, 1e-3 * kRad / w);
}

// omega below what the measured phase gives at xi_max needs a phase error: a kinked profile, flat
// above.
TEST(FamilyProfileTest, OmegaAgainstTheClosedForm) {
  const FamilyProblem problem = One();
  const Experiment& e = problem.experiments[0];
  const auto profile = ProfileFamily(problem, Quantity(problem, "exp1.omega_hz"),
                                     EnumerateMembers(problem, 20, 1, 1).members);
  ASSERT_TRUE(profile.has_value());
  EXPECT_EQ(profile->flagged, 0u);
  std::size_t kinked = 0;
  for (const ProfilePoint& point : profile->points) {
    // Next to f itself xi would have to be below the search's least.
    if (point.value > e.frequency_hz - 0.01) continue;
    const double y = 0.5 * (e.frequency_hz / point.value - point.value / e.frequency_hz);
    const double lag_deg = std::atan(y / 0.3) / kRad;  // the least lag with xi up to 0.3
    const double expected = std::max(0.0, (lag_deg + e.phase_deg) / 0.5);
    EXPECT_NEAR(point.cost, expected, 1e-3) << point.value;
    kinked += expected > 0.01;
  }
  EXPECT_GE(kinked, 3u);
}

TEST(FamilyProfileTest, NamesThatAreNoQuantityAreRefused) {
  const FamilyProblem problem = One();
  ExpressionError error;
  for (const char* text : {"xi", "exp7.xi", "1 + 2", "exp1.xi +", ""}) {
    EXPECT_FALSE(ParseQuantity(text, problem, error).has_value()) << text;
    EXPECT_FALSE(error.message.empty()) << text;
  }
}

}  // namespace
}  // namespace howl::local_search_test
