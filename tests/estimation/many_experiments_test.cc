// From two experiments to a hundred: answers that do not depend on how many are fitted together,
// and work that grows as their number does.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "estimation/fit/joint_fit.h"
#include "tests/known_loops.h"

namespace howl::many_experiments_test {
namespace {

JointFit Fit(const std::vector<Experiment>& experiments,
             const ModelSpec& model = DefaultModelSpec(), int starts = 1) {
  return SolveJoint(JointProblem(experiments, model, DefaultResidualSet()), {.starts = starts}, 1,
                    1);
}

// The sparse solver and the elimination of each experiment's parameters, against the dense solver.
TEST(ManyExperiments, OfTheirOwnFitAsTheyDoByThemselves) {
  const KnownLoops known = DrawKnownLoops(60, 1, 0.01, 0.5);
  ResidualSet residuals = DefaultResidualSet();
  for (const ResidualKind kind :
       {ResidualKind::kXiIncreasing, ResidualKind::kOmegaPrior, ResidualKind::kTauPrior}) {
    residuals[kind].enabled = false;  // nothing ties one experiment to another
  }
  const auto fit = [&](const std::vector<Experiment>& experiments) {
    const JointProblem problem(experiments, DefaultModelSpec(), residuals);
    return SolveJoint(problem, {.starts = 1}, 1, 1);
  };
  const JointFit together = fit(known.experiments);
  ASSERT_TRUE(together.converged) << together.termination;
  double cost = 0.0;
  for (std::size_t i = 0; i < known.experiments.size(); ++i) {
    const JointFit alone = fit({known.experiments[i]});
    const LoopModel& model = alone.models.front();
    EXPECT_NEAR(together.models[i].omega_hz, model.omega_hz, 1e-7 * model.omega_hz);
    EXPECT_NEAR(together.models[i].xi, model.xi, 1e-6 * model.xi);
    EXPECT_NEAR(together.models[i].N, model.N, 1e-6 * model.N);
    EXPECT_NEAR(together.models[i].tau_s, model.tau_s, 1e-7 * model.tau_s);
    cost += alone.cost;
  }
  EXPECT_NEAR(together.cost, cost, 1e-8 * cost);
}

// With one delay for all, which the elimination's border is; truth is the loop that made the table.
TEST(ManyExperiments, ShareADelay) {
  KnownLoops known = DrawKnownLoops(60, 1);
  ModelSpec model = DefaultModelSpec();
  model[ParameterKind::kTau].scope = ParameterScope::kShared;
  const JointFit fit = Fit(known.experiments, model);
  ASSERT_TRUE(fit.converged) << fit.termination;
  const double tau_s = fit.models.front().tau_s;
  EXPECT_NEAR(tau_s, 0.72 / 215.0, 0.01 * tau_s);
  // One number from sixty: its standard deviation is about that of one experiment over sqrt(60).
  JointFit one = Fit({known.experiments[30]}, model);
  const auto std_of_tau = [](const JointFit& of) {
    const auto at = std::ranges::find(of.parameters, "tau_s", &FitParameter::name);
    return at->std_relative;
  };
  const Identifiability stated =
      IdentifiabilityAt(JointProblem(known.experiments, model, DefaultResidualSet()), fit.logs);
  const auto at = std::ranges::find(fit.free_names, "tau_s") - fit.free_names.begin();
  EXPECT_NEAR(stated.log_std.at(static_cast<std::size_t>(at)), std_of_tau(one) / std::sqrt(60.0),
              0.5 * std_of_tau(one) / std::sqrt(60.0));
}

double CpuSeconds(const std::function<void()>& work) {
  const std::clock_t before = std::clock();
  work();
  return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
}

// Four times the experiments: linear work takes 4 times as long, a square 16, a cube 64.
TEST(ManyExperiments, FitInTimeThatGrowsAsTheirNumber) {
  for (const ParameterScope scope : {ParameterScope::kExperiment, ParameterScope::kShared}) {
    ModelSpec model = DefaultModelSpec();
    model[ParameterKind::kTau].scope = scope;
    const auto seconds = [&](int count) {
      const KnownLoops known = DrawKnownLoops(count, 1);
      return CpuSeconds([&] { EXPECT_TRUE(Fit(known.experiments, model, 4).converged); });
    };
    const double few = seconds(48);
    EXPECT_LT(seconds(192), 9.0 * few + 0.1);
  }
}

TEST(ManyExperiments, AreBoundedInTimeThatGrowsAsTheirNumber) {
  const auto seconds = [](int count) {
    FamilyProblem problem;
    problem.experiments = DrawKnownLoops(count, 1).experiments;
    return CpuSeconds([&] {
      Enclosure enclosure(problem, {.width = 0.01});
      EXPECT_TRUE(enclosure.Run());
      EXPECT_FALSE(enclosure.Witnesses().empty());
    });
  };
  const double few = seconds(24);
  EXPECT_LT(seconds(96), 9.0 * few + 0.1);
}

TEST(ManyExperiments, TwoAndSixtyHaveAFitAndAFamily) {
  for (const int count : {2, 60}) {
    const KnownLoops known = DrawKnownLoops(count, 1, 0.003, 0.15);
    const JointFit fit = Fit(known.experiments, DefaultModelSpec(), 3);
    EXPECT_TRUE(fit.converged) << fit.termination;
    EXPECT_EQ(fit.models.size(), known.models.size());
    FamilyProblem problem;
    problem.experiments = known.experiments;
    const Enumeration listed = EnumerateMembers(problem, 50, 1);
    EXPECT_EQ(listed.members.size(), 50u) << count;
    const MemberSample drawn = SampleMembers(problem, {.count = 64, .seed = 1});
    EXPECT_EQ(drawn.members.size(), 64u) << count;
    for (const Member& member : drawn.members) EXPECT_TRUE(Holds(problem, member));
    Enclosure enclosure(problem, {.width = 0.01});
    ASSERT_TRUE(enclosure.Run());
    // The loops that made the table are members where noise stays within the test's tolerances,
    // and then lie within every bound.
    const bool truth_is_member = Holds(problem, known.models);
    for (std::size_t i = 0; truth_is_member && i < known.models.size(); ++i) {
      const EnclosedBound bound = enclosure.Bound(i, FamilyParameter::kXi);
      EXPECT_LE(bound.outer.lo, known.models[i].xi);
      EXPECT_GE(bound.outer.hi, known.models[i].xi);
    }
    for (const Member& member : drawn.members) {
      for (std::size_t i = 0; i < member.size(); ++i) {
        const EnclosedBound bound = enclosure.Bound(i, FamilyParameter::kOmega);
        EXPECT_TRUE(bound.outer.Contains(member[i].omega_hz));
      }
    }
  }
}

}  // namespace
}  // namespace howl::many_experiments_test
