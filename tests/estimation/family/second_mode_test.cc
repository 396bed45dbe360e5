// What the test asks of the second mode: its share at the limit cycle and the loop's gain at the
// lines. Truth: the falsification test of reference.h, and the modes by std::complex.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "estimation/family/answers/conflict/conflict.h"
#include "estimation/family/bounds/contract/cell_contractor.h"
#include "estimation/family/bounds/contract/contract.h"
#include "estimation/family/bounds/contract/second_mode_bound.h"
#include "estimation/family/bounds/feasible.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::second_mode_test {
namespace {

FamilyProblem Problem(std::size_t experiments) {
  FamilyProblem problem{.experiments = R228()};
  problem.experiments.resize(experiments);
  for (Experiment& experiment : problem.experiments) experiment.lines = {{750.0, 10.0}};
  problem.model.modes = 2;
  problem.model[ParameterKind::kM].scope = ParameterScope::kExperiment;
  problem.domain[ParameterKind::kXi].lo = 0.02;
  problem.test.second_crossing_tolerance_deg = 90.0;
  problem.test.second_crossing_gain_min = 0.9;
  return problem;
}

double Share(const LoopModel& m, double f) {
  const reference::Model first{m.omega_hz, m.xi, m.N, 0, m.tau_s, m.harmonic_ratio};
  const reference::Model second{m.omega_hz, m.xi, 0, m.M, m.tau_s, m.harmonic_ratio};
  return static_cast<double>(std::abs(reference::G(second, f)) / std::abs(reference::G(first, f)));
}

TEST(SecondModeTest, ErrorsAreTheReferences) {
  const FamilyProblem problem = Problem(1);
  const Experiment& e = problem.experiments[0];
  const LoopModel m{.omega_hz = 210.0, .xi = 0.2, .N = 6000.0, .M = 4000.0, .tau_s = 3.4e-3};
  const ExperimentErrors errors = ComputeErrors(e, m);
  EXPECT_NEAR(errors.second_mode_share, Share(m, e.frequency_hz), 1e-12);
  EXPECT_NEAR(errors.second_crossing_gain,
              static_cast<double>(std::abs(reference::L(reference::From(m), 750.0))) * 0.703e-4,
              1e-12);
  EXPECT_TRUE(std::isnan(ComputeErrors(R228()[0], m).second_crossing_gain));
}

TEST(SecondModeTest, ShareOfIntervalsHoldsEveryPoint) {
  std::mt19937_64 random(3);
  const auto draw = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  for (int k = 0; k < 5000; ++k) {
    const double f = draw(150, 250), omega = f * draw(0.25, 1.1), xi = draw(1e-4, 0.8);
    const double relative = std::exp(draw(-5, 3)), r = draw(2, 4);
    const LoopModel m{omega, xi, 1.0, relative, 0.0, r};
    const double share = Share(m, f);
    const RoundingGuard guard;
    const auto around = [&](double value, double reach) {
      return Interval(value * (1 - draw(0, reach)), value * (1 + draw(0, reach)));
    };
    const Interval wide = SecondModeShareOf(around(omega, 0.3), around(xi, 0.9),
                                            around(relative, 0.5), Interval(r), Interval(f));
    ASSERT_LE(wide.lower(), share * (1 + 1e-12));
    ASSERT_GE(wide.upper(), share * (1 - 1e-12));
    const Interval point = SecondModeShareOf(Interval(omega), Interval(xi), Interval(relative),
                                             Interval(r), Interval(f));
    ASSERT_NEAR(point.lower() / share, 1.0, 1e-9);
    ASSERT_NEAR(point.upper() / share, 1.0, 1e-9);
  }
}

// A cell around a member, as wide as chance has it.
Cell CellAround(const CellContractor& contractor, const FamilyProblem& problem,
                const Member& member, std::mt19937_64& random) {
  Cell cell = contractor.Root();
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double reach = std::pow(10.0, -4.0 * uniform(random));
  for (std::size_t i = 0; i < member.size(); ++i) {
    const LoopModel& m = member[i];
    const auto z = reference::G(reference::From(m), problem.experiments[i].frequency_hz);
    const auto narrow = [&](CellVariable variable, double value) {
      const double size = reach * std::abs(value);
      Narrow(cell.boxes[i][variable],
             Interval(value - uniform(random) * size, value + uniform(random) * size));
    };
    narrow(kCellOmega, m.omega_hz);
    narrow(kCellXi, m.xi);
    narrow(kCellTangent, static_cast<double>(-z.imag() / z.real()));
    narrow(kCellGain, static_cast<double>(std::abs(z)));
    narrow(kCellN, m.N);
    narrow(kCellM, m.M);
    narrow(kCellRelative, m.M / m.N);
    narrow(kCellTau, m.tau_s);
  }
  return cell;
}

bool Contains(const Cell& cell, const Member& member) {
  const auto in = [](const Interval& x, double value) {
    const double slack = 1e-12 * std::abs(value);
    return x.lower() - slack <= value && value <= x.upper() + slack;
  };
  for (std::size_t i = 0; i < member.size(); ++i) {
    const ExperimentBox& box = cell.boxes[i];
    const LoopModel& m = member[i];
    if (!in(box[kCellOmega], m.omega_hz) || !in(box[kCellXi], m.xi) || !in(box[kCellN], m.N) ||
        !in(box[kCellM], m.M) || !in(box[kCellRelative], m.M / m.N) ||
        !in(box[kCellTau], m.tau_s)) {
      return false;
    }
  }
  return true;
}

// Members near every edge: of a family whose limits are then drawn in until they just hold.
TEST(SecondModeTest, ContractorsCutNoMember) {
  FamilyProblem problem = Problem(3);
  problem.test.second_mode_share_max = 0.5;
  problem.test.second_crossing_gain_min = 0.3;
  const std::vector<Member> members = EnumerateMembers(problem, 300, 4, 1).members;
  ASSERT_GT(members.size(), 200u);
  std::mt19937_64 random(5);
  int sharpened = 0;
  for (const Member& member : members) {
    ASSERT_TRUE(reference::Passes(problem.experiments, member, problem.test, 1e-9L));
    double share = 0.0, gain = 1e9;
    for (std::size_t i = 0; i < member.size(); ++i) {
      share = std::max(share, Share(member[i], problem.experiments[i].frequency_hz));
      gain = std::min(
          gain, static_cast<double>(std::abs(reference::L(reference::From(member[i]), 750.0))) *
                    std::abs(*problem.experiments[i].flame_slope));
    }
    FamilyProblem tight = problem;
    tight.test.second_mode_share_max = share * (1 + 1e-9);
    tight.test.second_crossing_gain_min = gain * (1 - 1e-9);
    const CellContractor contractor(tight);
    for (int k = 0; k < 10; ++k) {
      Cell cell = CellAround(contractor, tight, member, random);
      ASSERT_TRUE(contractor.Contract(cell));
      ASSERT_TRUE(Contains(cell, member));
    }
    // A hair's breadth beyond either limit, and a small cell has none.
    for (const bool by_share : {true, false}) {
      FamilyProblem beyond = tight;
      if (by_share) {
        beyond.test.second_mode_share_max = share * (1 - 1e-3);
      } else {
        beyond.test.second_crossing_gain_min = gain * (1 + 1e-3);
      }
      const CellContractor sharp(beyond);
      Cell cell = sharp.Root();
      for (std::size_t i = 0; i < member.size(); ++i) {
        const auto at = [](double value) {
          return Interval(value * (1 - 1e-7), value * (1 + 1e-7));
        };
        Narrow(cell.boxes[i][kCellOmega], at(member[i].omega_hz));
        Narrow(cell.boxes[i][kCellXi], at(member[i].xi));
        Narrow(cell.boxes[i][kCellN], at(member[i].N));
        Narrow(cell.boxes[i][kCellM], at(member[i].M));
      }
      sharpened += sharp.Contract(cell) ? 0 : 1;
    }
  }
  EXPECT_EQ(sharpened, 2 * static_cast<int>(members.size()));
}

// The paper's branch: without the condition the published experiments have members down to a third
// of the cycle's frequency, with it omega stays at the cycle's.
TEST(SecondModeTest, MembersStayOnThePapersBranchByDefault) {
  for (const bool shared : {false, true}) {
    FamilyProblem problem{.experiments = R228()};
    problem.model.modes = 2;
    problem.domain[ParameterKind::kXi].lo = 0.02;
    problem.model[ParameterKind::kM].scope =
        shared ? ParameterScope::kShared : ParameterScope::kExperiment;
    std::vector<Member> members = EnumerateMembers(problem, 200, 1, 2).members;
    ASSERT_GT(members.size(), 100u) << shared;
    const MemberSample sample = SampleMembers(problem, {.count = 200, .seed = 2, .threads = 2});
    ASSERT_EQ(sample.members.size(), 200u) << shared;
    members.insert(members.end(), sample.members.begin(), sample.members.end());
    const std::optional<Member> local = FindMemberLocally(problem);
    ASSERT_TRUE(local.has_value()) << shared;
    members.push_back(*local);
    for (const Member& member : members) {
      ASSERT_TRUE(reference::Passes(problem.experiments, member, problem.test, 1e-9L));
      for (std::size_t i = 0; i < member.size(); ++i) {
        EXPECT_GT(member[i].omega_hz, 0.75 * problem.experiments[i].frequency_hz);
      }
    }
    problem.test.second_mode_share_max = std::numeric_limits<double>::infinity();
    double lowest = 1.0;
    for (const Member& member : EnumerateMembers(problem, 200, 1, 2).members) {
      lowest = std::min(lowest, member[0].omega_hz / problem.experiments[0].frequency_hz);
    }
    EXPECT_LT(lowest, 0.75) << shared;
  }
}

TEST(SecondModeTest, ConflictNamesTheGainAtTheLineAndWhatWouldDo) {
  FamilyProblem problem = Problem(1);
  problem.test.second_crossing_gain_min = 100.0;
  const Conflict conflict = ExplainEmpty(problem, 2);
  ASSERT_TRUE(conflict.is_empty);
  const auto names = ConflictNames(conflict);
  EXPECT_NE(std::ranges::find(names, "second_crossing_gain_min"), names.end());
  for (const SmallestChange& change : conflict.changes) {
    if (change.target.kind != ChangeKind::kCondition ||
        change.target.condition != Condition::kSecondCrossingGain) {
      continue;
    }
    ASSERT_TRUE(change.helps);
    ASSERT_TRUE(change.pasted.has_value());
    EXPECT_LT(*change.pasted, 100.0);
    EXPECT_GT(*change.pasted, 0.9);
    problem.test.second_crossing_gain_min = *change.pasted;
    EXPECT_TRUE(Holds(problem, change.member));
    return;
  }
  ADD_FAILURE() << "no change of second_crossing_gain_min";
}

}  // namespace
}  // namespace howl::second_mode_test
