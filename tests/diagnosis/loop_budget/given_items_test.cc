// A search that begins with items that are known.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::given_items_test {
namespace {

constexpr double kCutoff_hz = 500.0;

std::vector<LoopRecord> DuctsBehindALowPass() {
  return DuctsAt({1.2, 1.5, 1.8}, [](Record* record) { LowPass(kCutoff_hz, record); });
}

// With the freedom of the acoustics and the instrument given there is nothing left to find, and the
// low-pass has its value.
TEST(GivenItems, AreOfTheBase) {
  LoopForm poorer = DuctsForm();
  poorer.structure.complex_residues = false;
  LoopBudgetOptions how = Among({"complex_residues", "q_sensor_lowpass", "channel_skew"});
  how.given = {"complex_residues", "q_sensor_lowpass", "complex_residues"};
  const LoopDiagnosis found = DiagnoseLoops(DuctsBehindALowPass(), poorer, how);
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kNone) << found.diagnosis.effect;
  EXPECT_EQ(found.items, how.given);
  EXPECT_TRUE(found.base.structure.complex_residues);
  ASSERT_EQ(found.base.effects.size(), 1u);
  EXPECT_EQ(found.base.effects[0].effect->id(), "q_sensor_lowpass");
  EXPECT_NEAR(found.base.effects[0].values[0], kCutoff_hz, 0.03 * kCutoff_hz);
  const Budget& budget = *found.diagnosis.budget;
  // What the loop has already is not there twice.
  ASSERT_EQ(budget.given.size(), 2u);
  EXPECT_EQ(budget.given[0].item, "complex_residues");
  EXPECT_EQ(budget.given[1].item, "q_sensor_lowpass");
  ASSERT_EQ(budget.given[1].parameters.size(), 1u);
  EXPECT_LT(budget.given[1].parameters[0].low, kCutoff_hz);
  EXPECT_GT(budget.given[1].parameters[0].high, kCutoff_hz);
  ASSERT_TRUE(budget.gap_without_given.has_value());
  EXPECT_GT(*budget.gap_without_given, 0.3);
  EXPECT_LT(budget.gap_before, 0.1 * *budget.gap_without_given);
}

TEST(LongGivenItems, AreNotSpokenOfWhereThereAreNone) {
  const LoopDiagnosis found =
      DiagnoseLoops(DuctsBehindALowPass(), DuctsForm(), Among({"q_sensor_lowpass"}));
  EXPECT_FALSE(found.diagnosis.budget->gap_without_given.has_value());
}

// What is not there is kept all the same, and what is there is found beside it.
TEST(LongGivenItems, LeaveTheRestToBeFound) {
  LoopBudgetOptions how = Among({"duct_noise", "q_sensor_lowpass"});
  how.given = {"duct_noise"};
  const LoopDiagnosis found = DiagnoseLoops(DuctsBehindALowPass(), DuctsForm(), how);
  EXPECT_EQ(found.diagnosis.effect, "q_sensor_lowpass");
  EXPECT_EQ(found.items, (std::vector<std::string>{"duct_noise", "q_sensor_lowpass"}));
  EXPECT_EQ(found.best.structure.noise.size(), LeastNoise().size() + 1);
}

}  // namespace
}  // namespace howl::given_items_test
