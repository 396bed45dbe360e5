// Why budgets' loops are not the rig's, by hand.
#include "diagnosis/loop_budget/why_unknown.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

namespace howl::why_unknown_test {
namespace {

Budget Path(double share, double extra_s) {
  BudgetEntry entry;
  entry.item = "second_delay_path";
  entry.parameters = {{"share", share, share, share, ""}, {"extra_s", extra_s, 0.0, 1.0, "s"}};
  Budget out;
  out.entries.push_back(entry);
  return out;
}

// A share of the flame is none below zero. How long a delay may be depends on the rig.
TEST(WhyUnknown, NoEffectHasAValueThatItCannotHave) {
  EXPECT_EQ(ValueThatCannotBe(Path(-0.08, 1e-3)),
            "second_delay_path would have a share that it cannot have");
  EXPECT_EQ(ValueThatCannotBe(Path(0.9, 1e-3)),
            "second_delay_path would have a share that it cannot have");
  EXPECT_EQ(ValueThatCannotBe(Path(0.2, 1e-3)), "");
  EXPECT_EQ(ValueThatCannotBe(Path(0.2, 1.0)), "");
  Budget of_no_catalogue = Path(-0.08, 1e-3);
  of_no_catalogue.entries[0].item = "duct_noise";
  EXPECT_EQ(ValueThatCannotBe(of_no_catalogue), "");
}

// A right loop leaves a gap of its floor, by the errors of its parameters.
TEST(WhyUnknown, MoreThanTheFloorIsLeft) {
  Budget budget = Path(0.2, 1e-3);
  budget.floor = 0.05;
  for (const double gap : {0.0, 0.05}) {
    budget.gap_left = gap;
    EXPECT_EQ(WhyUnknown(budget, false, 1), "");
  }
  budget.gap_left = 0.06;
  EXPECT_NE(WhyUnknown(budget, false, 0), "");
  EXPECT_NE(WhyUnknown(budget, false, 1), "");
  budget.gap_left = 0.0;
  EXPECT_NE(WhyUnknown(budget, true, 1), "");
  EXPECT_EQ(WhyUnknown(budget, false, 2), "");
  EXPECT_NE(WhyUnknown(budget, false, 3), "");
}

// Where a right loop's own gap is as large as what no loop foretells, no gap refutes one.
TEST(WhyUnknown, FloorThatNoGapExceeds) {
  Budget budget = Path(0.2, 1e-3);
  budget.floor = 0.5;
  EXPECT_EQ(WhyUnknown(budget, false, 1), "");
  budget.floor = 0.9;
  EXPECT_NE(WhyUnknown(budget, false, 1), "");
  EXPECT_NE(WhyUnknown(budget, false, 0), "");
}

// What both halves gain by an item may differ, but neither may speak against it as strongly as
// anything has to speak for it; where halves were not fitted nothing is said.
TEST(WhyUnknown, HalfOfTheRecordsSpeaksAgainstAnItem) {
  Budget budget = Path(0.2, 1e-3);
  constexpr double kNotFitted = std::numeric_limits<double>::quiet_NaN();
  for (const auto& halves :
       {std::array{200.0, 3.0}, std::array{9.0, -2.0}, std::array{kNotFitted, kNotFitted}}) {
    budget.entries[0].lost_on_halves = halves;
    EXPECT_EQ(WhyUnknown(budget, false, 1), "");
  }
  for (const auto& halves : {std::array{-166.0, 59.0}, std::array{451.0, -4.0}}) {
    budget.entries[0].lost_on_halves = halves;
    EXPECT_EQ(WhyUnknown(budget, false, 1),
              "one half of the records is foretold better without second_delay_path");
  }
}

}  // namespace
}  // namespace howl::why_unknown_test
