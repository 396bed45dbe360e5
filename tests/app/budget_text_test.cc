// A budget as the terminal shows it.
#include "app/text/budget_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace howl::budget_text_test {
namespace {

BudgetEntry Entry(const char* item, double first_half, double second_half) {
  BudgetEntry out;
  out.item = item;
  out.gap_before = 0.8;
  out.gap_after = 0.5;
  out.lost_on_halves = {first_half, second_half};
  return out;
}

TEST(BudgetText, NamesWhatOneHalfDoesNotBearOut) {
  Budget budget;
  budget.gap_before = 0.8;
  budget.gap_left = 0.5;
  budget.entries = {Entry("duct_noise", 50.0, 54.0), Entry("crosstalk_p_to_q", -25.0, 17.0),
                    Entry("mains_hum", 2.0, -2.0)};
  EXPECT_THAT(BudgetText(budget),
              testing::HasSubstr("doubtful, as one half of the records is foretold no better with "
                                 "it: crosstalk_p_to_q, mains_hum\n"));
  budget.entries.resize(1);
  EXPECT_THAT(BudgetText(budget), testing::Not(testing::HasSubstr("doubtful")));
}

TEST(BudgetText, SaysHowFarGivenItemsTookTheGap) {
  Budget budget;
  budget.gap_before = 0.25;
  EXPECT_THAT(BudgetText(budget), testing::Not(testing::HasSubstr("given")));
  budget.gap_without_given = 0.75;
  EXPECT_THAT(BudgetText(budget),
              testing::HasSubstr("with the items that were given the gap, left out, goes from "
                                 "0.750 to 0.250\n"));
}

TEST(BudgetText, SaysWhatGivenItemsComeTo) {
  Budget budget;
  budget.gap_without_given = 0.75;
  budget.given = {{"q_sensor_lowpass", "order 1", {{"cutoff_hz", 244.7, 240.0, 250.0, "Hz"}}}};
  EXPECT_THAT(
      BudgetText(budget),
      testing::ContainsRegex("given *estimate\nq_sensor_lowpass .order 1. *cutoff_hz 244.7 Hz\n"));
}

// Where an effect stands in the loop is part of what was found.
TEST(BudgetText, NamesTheFormOfAnEffect) {
  Budget budget;
  budget.entries = {Entry("second_delay_path", 50.0, 54.0)};
  EXPECT_THAT(BudgetText(budget), testing::Not(testing::HasSubstr("second_delay_path (")));
  budget.entries[0].form = "side before_flame";
  EXPECT_THAT(BudgetText(budget), testing::HasSubstr("second_delay_path (side before_flame)"));
}

TEST(BudgetText, SaysHowLargeMayBeWhatWasNotFound) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Budget budget;
  EXPECT_THAT(BudgetText(budget), testing::Not(testing::HasSubstr("not found")));
  budget.not_found = {{"q_sensor_lowpass", "order 1", "cutoff_hz", "Hz", 2040.0, kInfinity},
                      {"crosstalk_p_to_q", "", "rel", "", -0.0123, 0.0456}};
  EXPECT_THAT(BudgetText(budget),
              testing::ContainsRegex("q_sensor_lowpass .order 1. *cutoff_hz *2040 Hz *-"));
  EXPECT_THAT(BudgetText(budget), testing::ContainsRegex("crosstalk_p_to_q *rel *-0.012 *0.046"));
}

}  // namespace
}  // namespace howl::budget_text_test
