// What (5b) says of the first mode bounds omega, N and M where xi may vanish. That no member is
// lost is asked in second_mode_test.cc, of the whole contractor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimation/family/bounds/contract/carrying_mode_bound.h"
#include "estimation/family/bounds/contract/cell_contractor.h"
#include "estimation/family/members/enumerate.h"
#include "tests/r228.h"

namespace howl::carrying_mode_test {
namespace {

FamilyProblem UndampedTwoModes() {
  FamilyProblem problem{.experiments = R228()};
  problem.experiments.resize(2);
  problem.model.modes = 2;
  problem.test.second_mode_share_max = 0.1;
  return problem;
}

TEST(CarryingModeTest, OmegaNAndMAreBoundedWithoutALeastDamping) {
  const FamilyProblem problem = UndampedTwoModes();
  const CellContractor contractor(problem);
  Cell cell = contractor.Root();
  ASSERT_TRUE(contractor.Contract(cell));
  const double s = problem.test.second_mode_share_max;
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    const Experiment& e = problem.experiments[i];
    const ExperimentBox& box = cell.boxes[i];
    // |sinh(ln(f / omega))| = xi |tan(arg(N U_1))|, whose argument is G's to within asin s.
    const double turn = std::abs(e.phase_deg) + problem.test.phase_tolerance_deg;
    const double y = problem.test.xi_max * std::tan(turn * kRadPerDeg + std::asin(s));
    EXPECT_GE(box[kCellOmega].lower(), e.frequency_hz * std::exp(-std::asinh(y)) * (1.0 - 1e-9));
    EXPECT_LE(box[kCellOmega].upper(), e.frequency_hz * std::exp(std::asinh(y)) * (1.0 + 1e-9));
    EXPECT_LT(box[kCellN].upper(), 1e6);
    EXPECT_LT(box[kCellM].upper(), 1e6);
  }
}

TEST(CarryingModeTest, MembersLieWithinAndComeNear) {
  const FamilyProblem problem = UndampedTwoModes();
  const CellContractor contractor(problem);
  Cell cell = contractor.Root();
  ASSERT_TRUE(contractor.Contract(cell));
  const std::vector<Member> members = EnumerateMembers(problem, 300, 6, 1).members;
  ASSERT_GT(members.size(), 100u);
  double largest = 0.0;
  for (const Member& member : members) {
    for (std::size_t i = 0; i < member.size(); ++i) {
      EXPECT_GE(member[i].omega_hz, cell.boxes[i][kCellOmega].lower());
      EXPECT_LE(member[i].omega_hz, cell.boxes[i][kCellOmega].upper());
      EXPECT_LE(member[i].N, cell.boxes[i][kCellN].upper());
      EXPECT_LE(member[i].M, cell.boxes[i][kCellM].upper());
      largest = std::max(largest, member[i].N / cell.boxes[i][kCellN].upper());
    }
  }
  // The bound is one contraction of the whole domain, no search: that it is of the right size.
  EXPECT_GT(largest, 0.5);
}

}  // namespace
}  // namespace howl::carrying_mode_test
