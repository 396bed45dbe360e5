// Equation (3) on every branch, and for every way to a member: the phase that the delay turns is
// that of the loop with the equations of reference.h, whole turns included.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::member_chart_test {
namespace {

FamilyProblem OnBranch(int delay_periods, bool shared_tau = false) {
  FamilyProblem problem;
  problem.experiments = R228();
  for (Experiment& experiment : problem.experiments) experiment.delay_periods = delay_periods;
  problem.domain.delay_periods = delay_periods;
  if (shared_tau) {
    problem.model[ParameterKind::kTau].scope = ParameterScope::kShared;
    problem.test.loop_phase_tolerance_deg = 100.0;
  }
  return problem;
}

// (360 f tau - 270 degrees - arg G) / 360 degrees: whole turns, but for the loop phase error.
double TurnsOf(const Experiment& experiment, const LoopModel& model) {
  const double f = experiment.frequency_hz;
  const double phase_deg = double(reference::Deg(reference::G(reference::From(model), f)));
  return f * model.tau_s - (270.0 + phase_deg) / 360.0;
}

void ExpectOnBranch(const FamilyProblem& problem, const Member& member) {
  ASSERT_EQ(member.size(), problem.experiments.size());
  for (std::size_t i = 0; i < member.size(); ++i) {
    EXPECT_NEAR(TurnsOf(problem.experiments[i], member[i]), problem.domain.delay_periods,
                problem.test.loop_phase_tolerance_deg / 360.0 + 1e-9);
  }
}

TEST(MemberChart, ClosedFormKeepsTheBranchOfItsExperiment) {
  for (const int periods : {0, 1, 2}) {
    for (const Experiment& experiment : OnBranch(periods).experiments) {
      const LoopModel model = ClosedFormMember(experiment, 0.1, {0.01, -0.5, 1.0});
      EXPECT_NEAR(TurnsOf(experiment, model), periods - 1.0 / 360.0, 1e-12);
      EXPECT_NEAR(DelayOf(experiment), ClosedFormMember(experiment, 0.1).tau_s, 1e-15);
    }
  }
}

TEST(MemberChart, EveryWayToAMemberKeepsTheBranch) {
  for (const bool shared_tau : {false, true}) {
    for (const int periods : {0, 1, 2}) {
      SCOPED_TRACE(std::to_string(periods) + (shared_tau ? " shared" : ""));
      const FamilyProblem problem = OnBranch(periods, shared_tau);
      const Enumeration drawn = EnumerateMembers(problem, 20, 1, 1);
      ASSERT_EQ(drawn.members.size(), 20u);
      for (const Member& member : drawn.members) ExpectOnBranch(problem, member);
      const MemberSample sample = SampleMembers(problem, {.count = 20, .seed = 1});
      ASSERT_EQ(sample.members.size(), 20u);
      for (const Member& member : sample.members) ExpectOnBranch(problem, member);
      const std::optional<LocalSolution> local =
          LocalSearch(problem).ReduceViolation(drawn.members[0], 0.0);
      ASSERT_TRUE(local.has_value());
      ExpectOnBranch(problem, local->member);
    }
  }
}

}  // namespace
}  // namespace howl::member_chart_test
