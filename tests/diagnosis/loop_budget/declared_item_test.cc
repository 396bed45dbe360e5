// Effects that a user declares, as items of a budget.
#include <gtest/gtest.h>

#include <complex>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/declare.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::declared_item_test {
namespace {

const EffectParameter kShare{"share", "", 0.0, 0.0, 0.9, {0.1, 0.3}};

// p behind a long line, which is no item of its own. Its bounds are in Hz as they are stated,
// however slow the rig is.
TEST(DeclaredItem, IsNamedWithItsValue) {
  constexpr double kCorner_hz = 700.0;
  std::vector<LoopRecord> rig = DuctsAt({1.2, 1.5, 1.8}, [](Record* record) {
    Filter([](double hz) { return 1.0 / std::complex<double>(1.0, hz / kCorner_hz); },
           record->sampling_hz, &record->pressure);
  });
  constexpr double kFaster = 0.125;
  for (LoopRecord& each : rig) {
    each.record.sampling_hz *= kFaster;
    each.cycle_hz *= kFaster;
  }
  LoopBudgetOptions options = Among({"channel_skew", "p_sensor_resonance"});
  options.declared = {std::make_shared<DeclaredEffect>(
      Declare("mine", LoopPlace::kPressureRecorded, DeclaredForm::kTransfer,
              "1 / (1 + s / (2 * pi * corner_hz))",
              {"corner_hz",
               "Hz",
               std::numeric_limits<double>::infinity(),
               30.0,
               1e4,
               {50.0, 200.0, 1000.0},
               ParameterScale::kLogarithmic}))};
  const LoopDiagnosis found = DiagnoseLoops(rig, DuctsForm(), options);
  const std::vector<BudgetEntry>& entries = found.diagnosis.budget->entries;
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].item, "mine");
  EXPECT_EQ(entries[0].place.block, LoopBlock::kPressureInstrument);
  ASSERT_EQ(entries[0].parameters.size(), 1u);
  EXPECT_NEAR(entries[0].parameters[0].value, kFaster * kCorner_hz, 2.0);
}

TEST(DeclaredItem, IsOneTransferAtAllPoints) {
  const auto is_one = [](LoopPlace place, DeclaredForm form, const std::string& formula) {
    return DeclaredEffect(Declare("mine", place, form, formula, kShare)).IsOneTransfer();
  };
  EXPECT_TRUE(is_one(LoopPlace::kPressureRecorded, DeclaredForm::kTransfer, "1 / (1 + share*s)"));
  EXPECT_TRUE(is_one(LoopPlace::kHeatReleaseRecorded, DeclaredForm::kDelay, "1e-3 * share"));
  EXPECT_TRUE(is_one(LoopPlace::kFlameIn, DeclaredForm::kTransfer, "1 + share*exp(-1e-3*s)"));
  EXPECT_TRUE(is_one(LoopPlace::kFlameOut, DeclaredForm::kTransfer, "1 / (1 + 1e-3*share*s)"));
  // What differs from point to point, a change of the whole delay, and what is no transfer.
  EXPECT_FALSE(is_one(LoopPlace::kFlameIn, DeclaredForm::kTransfer, "1 + share*phi_position"));
  EXPECT_FALSE(is_one(LoopPlace::kDelay, DeclaredForm::kDelay, "1 + share*amplitude"));
  EXPECT_FALSE(is_one(LoopPlace::kAcoustics, DeclaredForm::kTransfer, "1 + share"));
  EXPECT_FALSE(is_one(LoopPlace::kHeatReleaseRecorded, DeclaredForm::kMap, "x + share*x^2"));
}

}  // namespace
}  // namespace howl::declared_item_test
