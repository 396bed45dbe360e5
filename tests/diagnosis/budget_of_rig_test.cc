// The budget of a rig of which no single cause is the whole.
#include "diagnosis/budget_of_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/forms/loop_item.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl {
namespace {

constexpr double kCutoff_hz = 400.0;

DiagnosisOptions Among(const std::vector<std::string>& kept) {
  DiagnosisOptions out;
  out.withheld = LoopItemIds();
  std::erase_if(out.withheld,
                [&](const std::string& id) { return std::ranges::find(kept, id) != kept.end(); });
  return out;
}

// q is recorded through a low-pass.
std::vector<DiagnosisExperiment> RigOfLowPass() {
  return SimulatePoints(
      2,
      [](RigParameters* each) {
        each->instruments = {
            std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, kCutoff_hz)};
      },
      7);
}

void ExpectLowPass(const BudgetEntry& entry, std::size_t points) {
  EXPECT_EQ(entry.item, "q_sensor_lowpass");
  ASSERT_EQ(entry.parameters.size(), 1u);
  EXPECT_LT(entry.parameters[0].low, kCutoff_hz);
  EXPECT_GT(entry.parameters[0].high, kCutoff_hz);
  EXPECT_LT(entry.parameters[0].high / entry.parameters[0].low, 1.2);
  EXPECT_GT(entry.lost_nats, 20.0);
  EXPECT_GT(entry.lost_on_halves[0], 0.0);
  EXPECT_GT(entry.lost_on_halves[1], 0.0);
  EXPECT_EQ(entry.experiments_better, points);
}

class Kept final : public FitUnits {
 public:
  std::optional<std::string> Recall(const std::string& key) override {
    const std::lock_guard lock(guard_);
    const auto found = all_.find(key);
    return found == all_.end() ? std::nullopt : std::optional<std::string>(found->second);
  }
  void Keep(const std::string& key, const std::string& bytes) override {
    const std::lock_guard lock(guard_);
    EXPECT_TRUE(all_.emplace(key, bytes).second) << key;
  }
  std::size_t size() const {
    const std::lock_guard lock(guard_);
    return all_.size();
  }

 private:
  mutable std::mutex guard_;
  std::map<std::string, std::string> all_;
};

TEST(BudgetOfRig, GoesOnWhereItWasStopped) {
  constexpr std::size_t kUntilStopped = 40;
  const std::vector<DiagnosisExperiment> rig = RigOfLowPass();
  DiagnosisOptions options = Among({"q_sensor_lowpass"});
  const std::optional<Budget> whole = BudgetOfRig(rig, 2, options);
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->entries.size(), 1u);
  ExpectLowPass(whole->entries[0], rig.size());
  Kept kept;
  options.memory = &kept;
  options.stopped = [&] { return kept.size() >= kUntilStopped; };
  EXPECT_FALSE(BudgetOfRig(rig, 2, options));
  EXPECT_GE(kept.size(), kUntilStopped);
  options.stopped = nullptr;
  const std::optional<Budget> resumed = BudgetOfRig(rig, 2, options);
  ASSERT_TRUE(resumed);
  ASSERT_EQ(resumed->entries.size(), 1u);
  EXPECT_EQ(resumed->entries[0].item, whole->entries[0].item);
  EXPECT_EQ(resumed->entries[0].lost_nats, whole->entries[0].lost_nats);
  EXPECT_EQ(resumed->entries[0].gap_after, whole->entries[0].gap_after);
}

TEST(BudgetOfRig, IsEmptyWhereThePapersLoopIsRight) {
  const std::optional<Budget> budget =
      BudgetOfRig(SimulateRig(), 2,
                  Among({"q_sensor_lowpass", "channel_skew", "complex_residues", "mode_detuning",
                         "delay_dispersion", "duct_noise"}));
  ASSERT_TRUE(budget);
  for (const BudgetEntry& entry : budget->entries) {
    ADD_FAILURE() << entry.item << ' ' << entry.lost_nats;
  }
}

TEST(LongBudgetOfRig, FindsBothOfTwoCauses) {
  const std::vector<DiagnosisExperiment> rig = SimulatePoints(
      3,
      [](RigParameters* each) {
        each->instruments = {
            std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, kCutoff_hz)};
        AddMode(2.2, 0.06, 0.25, each);
      },
      21);
  const std::optional<Budget> budget = BudgetOfRig(
      rig, 2,
      Among({"q_sensor_lowpass", "channel_skew", "mode_detuning", "own_damping", "acoustic_mode"}));
  ASSERT_TRUE(budget);
  const auto find = [&](const std::string& item) {
    const auto found = std::ranges::find(budget->entries, item, &BudgetEntry::item);
    return found == budget->entries.end() ? nullptr : &*found;
  };
  const BudgetEntry* lowpass = find("q_sensor_lowpass");
  ASSERT_NE(lowpass, nullptr);
  ExpectLowPass(*lowpass, rig.size());
  EXPECT_NE(find("acoustic_mode"), nullptr);
  EXPECT_GT(budget->gap_before, 0.5);
  EXPECT_LT(budget->gap_left, 0.2 * budget->gap_before);
}

}  // namespace
}  // namespace howl
