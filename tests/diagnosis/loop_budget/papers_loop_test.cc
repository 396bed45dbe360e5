// What a diagnosis finds beside the paper's loop, on rigs simulated with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bench/rig_loop_records.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::papers_loop_test {
namespace {

constexpr double kCutoff_hz = 400.0;

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

struct Stopped {};

// Ends the work once it has kept so many units.
class Kept final : public FitUnits {
 public:
  std::optional<std::string> Recall(const std::string& key) override {
    const std::lock_guard lock(guard_);
    if (all_.size() >= most) throw Stopped{};
    const auto found = all_.find(key);
    return found == all_.end() ? std::nullopt : std::optional<std::string>(found->second);
  }
  void Keep(const std::string& key, const std::string& bytes) override {
    const std::lock_guard lock(guard_);
    EXPECT_TRUE(all_.emplace(key, bytes).second) << key;
  }

  std::size_t most = std::numeric_limits<std::size_t>::max();

 private:
  std::mutex guard_;
  std::map<std::string, std::string> all_;
};

TEST(LongPapersLoop, ADiagnosisGoesOnWhereItWasStopped) {
  const std::vector<LoopRecord> rig = LoopRecordsOf(RigOfLowPass());
  LoopBudgetOptions options = Among({"q_sensor_lowpass"});
  const Budget whole = *DiagnoseLoops(rig, PapersForm(), options).diagnosis.budget;
  ASSERT_EQ(whole.entries.size(), 1u);
  ExpectLowPass(whole.entries[0], rig.size());
  Kept kept;
  options.units = &kept;
  kept.most = 40;
  EXPECT_THROW(DiagnoseLoops(rig, PapersForm(), options), Stopped);
  kept.most = std::numeric_limits<std::size_t>::max();
  const Budget resumed = *DiagnoseLoops(rig, PapersForm(), options).diagnosis.budget;
  ASSERT_EQ(resumed.entries.size(), 1u);
  EXPECT_EQ(resumed.entries[0].item, whole.entries[0].item);
  EXPECT_EQ(resumed.entries[0].lost_nats, whole.entries[0].lost_nats);
  EXPECT_EQ(resumed.entries[0].gap_after, whole.entries[0].gap_after);
}

TEST(PapersLoop, HasNothingBesideItWhereItIsRight) {
  LoopBudgetOptions options = Among({"q_sensor_lowpass", "channel_skew", "complex_residues",
                                     "mode_detuning", "delay_dispersion", "duct_noise"});
  options.one_delay = true;
  const LoopDiagnosis found = DiagnoseLoops(LoopRecordsOf(SimulateRig()), PapersForm(), options);
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kNone);
  for (const BudgetEntry& entry : found.diagnosis.budget->entries) {
    ADD_FAILURE() << entry.item << ' ' << entry.lost_nats;
  }
}

TEST(LongPapersLoop, LacksBothOfTwoCauses) {
  const std::vector<DiagnosisExperiment> rig = SimulatePoints(
      3,
      [](RigParameters* each) {
        each->instruments = {
            std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, kCutoff_hz)};
        AddMode(2.2, 0.06, 0.25, each);
      },
      21);
  const Budget budget = *DiagnoseLoops(LoopRecordsOf(rig), PapersForm(),
                                       Among({"q_sensor_lowpass", "channel_skew", "mode_detuning",
                                              "own_damping", "extra_acoustic_mode"}))
                             .diagnosis.budget;
  const auto find = [&](const std::string& item) {
    const auto found = std::ranges::find(budget.entries, item, &BudgetEntry::item);
    return found == budget.entries.end() ? nullptr : &*found;
  };
  const BudgetEntry* lowpass = find("q_sensor_lowpass");
  ASSERT_NE(lowpass, nullptr);
  ExpectLowPass(*lowpass, rig.size());
  EXPECT_NE(find("extra_acoustic_mode"), nullptr);
  EXPECT_GT(budget.gap_before, 0.5);
  EXPECT_LT(budget.gap_left, 0.2 * budget.gap_before);
}

}  // namespace
}  // namespace howl::papers_loop_test
