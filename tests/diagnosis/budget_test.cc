// The budget of the gap: what is found in rigs with two causes, with one, with none.
#include "diagnosis/budget/budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "diagnosis/budget/budget_search.h"
#include "diagnosis/budget/items/item_removal.h"
#include "diagnosis/budget/items/item_starts.h"
#include "diagnosis/budget/prediction_gap.h"
#include "diagnosis/budget/step_memory.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl {
namespace {

constexpr double kCutoff_hz = 400.0;
const std::vector<std::string> kFew = {"q_sensor_lowpass", "channel_skew", "extra_acoustic_mode"};

std::vector<DiagnosisExperiment> RigOfTwoCauses() {
  return SimulatePoints(
      3,
      [](RigParameters* rig) {
        rig->instruments = {std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, kCutoff_hz)};
        AddMode(2.2, 0.06, 0.25, rig);
      },
      21);
}

BudgetOptions Among(const std::vector<std::string>& kept) {
  BudgetOptions options;
  options.withheld = AllBut(kept);
  return options;
}

const BudgetEntry* Find(const Budget& budget, const std::string& item) {
  const auto found = std::ranges::find(budget.entries, item, &BudgetEntry::item);
  return found == budget.entries.end() ? nullptr : &*found;
}

TEST(LongBudget, FindsBothOfTwoCauses) {
  const Budget budget = FindBudget(RigOfTwoCauses(), {}, Among(kFew));
  const BudgetEntry* lowpass = Find(budget, "q_sensor_lowpass");
  ASSERT_NE(lowpass, nullptr);
  ASSERT_EQ(lowpass->parameters.size(), 1u);
  EXPECT_LT(lowpass->parameters[0].low, kCutoff_hz);
  EXPECT_GT(lowpass->parameters[0].high, kCutoff_hz);
  EXPECT_LT(lowpass->parameters[0].high / lowpass->parameters[0].low, 1.2);
  const bool mode = Find(budget, "extra_acoustic_mode") || Find(budget, "acoustic_mode");
  EXPECT_TRUE(mode);
  // Each is missed on every operating point and on either half of the records.
  for (const BudgetEntry& entry : budget.entries) {
    EXPECT_GT(entry.lost_nats, 5.0) << entry.item;
    if (entry.item != "q_sensor_lowpass") continue;
    EXPECT_GT(entry.lost_on_halves[0], 0.0);
    EXPECT_GT(entry.lost_on_halves[1], 0.0);
    EXPECT_EQ(entry.experiments_better, 3u);
  }
  EXPECT_GT(budget.gap_before, 0.5);
  EXPECT_LT(budget.gap_left, 0.2 * budget.gap_before);
}

TEST(Budget, IsEmptyWhereTheModelIsRight) {
  const Budget budget = FindBudget(SimulateRig(), {}, Among(kFew));
  for (const BudgetEntry& entry : budget.entries) ADD_FAILURE() << entry.item;
  EXPECT_LT(budget.gap_left, 0.1);
  EXPECT_LT(budget.acoustic_error, 0.02);
  EXPECT_LT(budget.flame_error, 0.02);
}

// The first score without a model error, against a prediction by hand: q from p through the loop's
// own acoustics is as good as the free transfer, and q from p at a wrong one is not.
TEST(PredictionGap, IsNearNothingForTheRightLoopAndLargeForAWrongOne) {
  const BudgetRecords records = MakeBudgetRecords(SimulateRig(), {});
  std::vector<JointBand> bands = records.whole;
  StructureFit fit = FitStructure(bands, StartOf(&bands, FitBase(records.records), BaseNoise()));
  const auto gap = [&] {
    double error = 0.0;
    double ceiling = 0.0;
    for (std::size_t e = 0; e < bands.size(); ++e) {
      const JointResiduals residuals =
          MakeJointResiduals(bands[e], *BaseEffect(), fit.shared, fit.points[e]);
      const JointEvaluation at =
          Evaluate(bands[e], fit.structure.noise, fit.shared, fit.points[e], residuals);
      for (const BandErrors& band : PredictionErrors(bands[e], residuals, at)) {
        error += band.error;
        ceiling += band.ceiling;
      }
    }
    return error / ceiling - 1.0;
  };
  EXPECT_NEAR(gap(), 0.0, 0.03);
  for (PointLoop& point : fit.points) point.acoustics[0] += 0.2;
  EXPECT_GT(gap(), 0.3);
}

TEST(BudgetItem, WhatIsAddedCanBeTakenAway) {
  const BudgetRecords records = MakeBudgetRecords(SimulateRig(), {});
  std::vector<JointBand> bands = records.whole;
  const StructureFit base = StartOf(&bands, FitBase(records.records), BaseNoise());
  std::vector<BudgetItem> has;
  StructureFit fit = base;
  for (BudgetItem item : BudgetItems({}, AllBut({"channel_skew", "delay_dispersion"}), {})) {
    if (item.kind == ItemKind::kEffect) {
      const EffectStart start = EffectStarts(fit.structure, item).back();
      item.forms = {start.form};
      fit = StartWith(bands, fit, start);
    } else {
      fit = StartsWith(bands, fit, item)[0];
    }
    has.push_back(item);
  }
  ASSERT_GE(has.size(), 7u);
  while (!has.empty()) {
    const std::size_t which = has.size() / 2;
    fit = Without(fit, has, which);
    has.erase(has.begin() + static_cast<std::ptrdiff_t>(which));
    EXPECT_EQ(fit.shared.values.size(), fit.structure.Joined()->parameters().size());
  }
  EXPECT_TRUE(fit.structure.effects.empty());
  EXPECT_FALSE(fit.structure.complex_residues);
  EXPECT_EQ(fit.structure.further_modes, 0);
  for (std::size_t e = 0; e < bands.size(); ++e) {
    EXPECT_TRUE(fit.points[e].modes.empty());
    EXPECT_EQ(fit.points[e].base_b.size(), 0);
    ASSERT_EQ(fit.points[e].noise.size(), base.points[e].noise.size());
    for (std::size_t j = 0; j < base.points[e].noise.size(); ++j) {
      EXPECT_EQ(fit.points[e].noise[j], base.points[e].noise[j]) << j;
    }
  }
}

class Kept final : public FitMemory {
 public:
  std::optional<std::string> Recall(const std::string& key) override {
    const auto found = all_.find(key);
    return found == all_.end() ? std::nullopt : std::optional<std::string>(found->second);
  }
  void Keep(const std::string& key, const std::string& bytes) override { all_[key] = bytes; }
  std::map<std::string, std::string> all_;
};

TEST(Budget, GoesOnWhereItWasStopped) {
  const std::vector<DiagnosisExperiment> rig =
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, kCutoff_hz)});
  BudgetOptions options = Among({"q_sensor_lowpass"});
  const Budget whole = FindBudget(rig, {}, options);
  ASSERT_EQ(whole.entries.size(), 1u);
  ASSERT_EQ(whole.entries[0].item, "q_sensor_lowpass");
  ASSERT_EQ(whole.entries[0].parameters.size(), 1u);
  EXPECT_LT(whole.entries[0].parameters[0].low, kCutoff_hz);
  EXPECT_GT(whole.entries[0].parameters[0].high, kCutoff_hz);
  Kept kept;
  options.memory = &kept;
  options.stopped = [&] { return !kept.all_.empty(); };
  EXPECT_TRUE(FindBudget(rig, {}, options).stopped);
  ASSERT_EQ(kept.all_.size(), 1u);
  options.stopped = nullptr;
  const Budget resumed = FindBudget(rig, {}, options);
  ASSERT_EQ(resumed.entries.size(), whole.entries.size());
  for (std::size_t i = 0; i < whole.entries.size(); ++i) {
    EXPECT_EQ(resumed.entries[i].item, whole.entries[i].item);
    EXPECT_EQ(resumed.entries[i].lost_nats, whole.entries[i].lost_nats);
    EXPECT_EQ(resumed.entries[i].gap_after, whole.entries[i].gap_after);
  }
}

TEST(StepMemory, TextIsReadBackToTheBitAndNonsenseRefused) {
  FinishedStep step;
  step.added = 4;
  step.equals = {"channel_skew"};
  step.fitted = {{4, 1, {0.1, -3e-17}}, {6, 0, {}}};
  const std::optional<FinishedStep> read = StepFromText(ToText(step), 9);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->added, step.added);
  EXPECT_EQ(read->equals, step.equals);
  ASSERT_EQ(read->fitted.size(), 2u);
  EXPECT_EQ(read->fitted[0].values, step.fitted[0].values);
  EXPECT_EQ(read->fitted[1].item, 6u);
  EXPECT_FALSE(StepFromText(ToText(step), 4));  // there are not so many items
  EXPECT_FALSE(StepFromText("", 9));
  EXPECT_FALSE(StepFromText("1 0 3 1 0", 9));
  const std::optional<FinishedStep> none = StepFromText(ToText({}), 9);
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->added);
}

}  // namespace
}  // namespace howl
