// What a verdict makes of a budget, by hand.
#include "diagnosis/loop_budget/loop_verdict.h"

#include <gtest/gtest.h>

#include <string>

namespace howl::loop_verdict_test {
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
TEST(LoopVerdict, NamesNoEffectWithAValueThatItCannotHave) {
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
TEST(LoopVerdict, IsUnknownWhereMoreThanTheFloorIsLeft) {
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

}  // namespace
}  // namespace howl::loop_verdict_test
