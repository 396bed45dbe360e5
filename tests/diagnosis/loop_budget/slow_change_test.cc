// Parameters that change slowly within a record, on ducts that are simulated step by step.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::slow_change_test {
namespace {

constexpr double kShort_s = 1.5;
const std::vector<std::string>& Offered() {
  static const std::vector<std::string> kItems = {"nonlinear_damping",
                                                  "amplitude_dependent_delay",
                                                  "amplitude_dependent_gain",
                                                  "slow_drift",
                                                  "duct_noise",
                                                  "p_sensor_noise"};
  return kItems;
}

std::vector<LoopRecord> Ducts(const std::function<void(ModalLoop*)>& change,
                              double duration_s = kShort_s) {
  std::vector<LoopRecord> out;
  for (const double gain : {1.2, 1.5, 1.8}) {
    out.push_back(DuctAt(gain, duration_s, static_cast<std::uint64_t>(100.0 * gain), {}, change));
  }
  return out;
}

// Of each record, and its mean.
double MeanSquaredAmplitude(const std::vector<LoopRecord>& records) {
  double sum = 0.0;
  for (const LoopRecord& each : records) {
    sum += 2.0 * std::pow(RootMeanSquare(each.record.pressure), 2);
  }
  return sum / static_cast<double>(records.size());
}

const BudgetEntry& OnlyEntry(const LoopDiagnosis& found) {
  static const BudgetEntry kNone;
  const std::vector<BudgetEntry>& entries = found.diagnosis.budget->entries;
  EXPECT_EQ(entries.size(), 1u) << found.diagnosis.effect;
  return entries.empty() ? kNone : entries[0];
}

TEST(SlowChanges, AreNotFoundWhereThereAreNone) {
  std::vector<std::string> offered = Offered();
  offered.push_back("parametric_noise");
  const LoopDiagnosis found = DiagnoseLoops(Ducts({}), DuctsForm(), Among(offered));
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kNone) << found.diagnosis.effect;
}

TEST(LongSlowChanges, OfTheDampingAreFound) {
  const double amplitude = std::sqrt(MeanSquaredAmplitude(Ducts({})));
  constexpr double kAdded = 0.03;
  const double per_square = kAdded / (amplitude * amplitude);
  const std::vector<LoopRecord> records =
      Ducts([&](ModalLoop* loop) { loop->damping_per_square = per_square; });
  const LoopDiagnosis found = DiagnoseLoops(records, DuctsForm(), Among(Offered()));
  const BudgetEntry& entry = OnlyEntry(found);
  EXPECT_EQ(entry.item, "nonlinear_damping");
  ASSERT_EQ(entry.parameters.size(), 1u);
  const double added = per_square * MeanSquaredAmplitude(records);
  EXPECT_NEAR(entry.parameters[0].value, added, 0.2 * added);
}

TEST(SlowChanges, OfTheFrequencyAreFound) {
  constexpr double kSpan = 0.02;
  const LoopDiagnosis found = DiagnoseLoops(
      Ducts([](ModalLoop* loop) { loop->frequency_span = kSpan; }), DuctsForm(), Among(Offered()));
  const BudgetEntry& entry = OnlyEntry(found);
  EXPECT_EQ(entry.item, "slow_drift");
  ASSERT_EQ(entry.parameters.size(), 1u);
  EXPECT_NEAR(entry.parameters[0].value, kSpan, 0.1 * kSpan);
}

// A cycle's amplitude hardly moves, and the delay with it: that takes long records to tell.
TEST(LongSlowChanges, OfTheDelayAreFound) {
  constexpr double kAdded_s = 3e-4;
  constexpr double kLong_s = 6.0;
  const double amplitude = std::sqrt(MeanSquaredAmplitude(Ducts({})));
  const std::vector<LoopRecord> records =
      Ducts([&](ModalLoop* loop) { loop->delay_per_amplitude = kAdded_s / amplitude; }, kLong_s);
  // Beside the delay a gain is worth 5.4 nats here, by chance or by what is not proportional: of
  // seven items that would pay, of so many it does not, nor of all, which would take two minutes.
  std::vector<std::string> offered = Offered();
  for (const char* more : {"q_sensor_noise", "background_noise", "noise_shape", "mains_hum",
                           "external_tone", "own_damping", "complex_residues", "mode_detuning",
                           "extra_acoustic_mode", "gamma_delays"}) {
    offered.emplace_back(more);
  }
  const LoopDiagnosis found = DiagnoseLoops(records, DuctsForm(), Among(offered));
  const BudgetEntry& entry = OnlyEntry(found);
  EXPECT_EQ(entry.item, "amplitude_dependent_delay");
  ASSERT_EQ(entry.parameters.size(), 1u);
  const double relative =
      kAdded_s * std::sqrt(MeanSquaredAmplitude(records)) / amplitude / DuctOfModes(2).tau_s;
  EXPECT_NEAR(entry.parameters[0].value, relative, 0.25 * relative);
}

// A flame that saturates with a memory, beside the curve by which it does so at once.
TEST(LongSlowChanges, OfTheGainAreFound) {
  constexpr double kLong_s = 6.0;
  const double amplitude = std::sqrt(MeanSquaredAmplitude(Ducts({})));
  const double per_amplitude = -0.3 / amplitude;
  const std::vector<LoopRecord> records =
      Ducts([&](ModalLoop* loop) { loop->gain_per_amplitude = per_amplitude; }, kLong_s);
  const LoopDiagnosis found = DiagnoseLoops(records, DuctsForm(), Among(Offered()));
  const BudgetEntry& entry = OnlyEntry(found);
  EXPECT_EQ(entry.item, "amplitude_dependent_gain");
  ASSERT_EQ(entry.parameters.size(), 1u);
  const double at_cycle = per_amplitude * std::sqrt(MeanSquaredAmplitude(records));
  const double slope = at_cycle / (1.0 + at_cycle);
  // Nats are half the square of what it is in its own deviations.
  const double deviation = std::abs(slope) / std::sqrt(2.0 * entry.lost_nats);
  EXPECT_NEAR(entry.parameters[0].value, slope, 3.0 * deviation);
}

TEST(SlowChanges, ThatFluctuateAreFound) {
  constexpr double kGain = 0.2;
  const std::vector<LoopRecord> records = Ducts([](ModalLoop* loop) { loop->gain_rms = kGain; });
  std::vector<std::string> offered = Offered();
  offered.push_back("parametric_noise");
  const LoopDiagnosis found = DiagnoseLoops(records, DuctsForm(), Among(offered));
  const BudgetEntry& entry = OnlyEntry(found);
  EXPECT_EQ(entry.item, "parametric_noise");
  // Whose spectrum is the same.
  EXPECT_EQ(entry.equals, (std::vector<std::string>{"intermittency", "delay_wander"}));
  ASSERT_EQ(entry.parameters.size(), 2u);
  // The cycle's amplitude follows the gain: a part of what it does passes for the flame's curve.
  EXPECT_LT(entry.parameters[0].value, 1.05 * kGain);
  EXPECT_GT(entry.parameters[0].value, 0.7 * kGain);
  EXPECT_LT(entry.parameters[1].low, 0.02);
  EXPECT_GT(entry.parameters[1].high, 0.02);
}

}  // namespace
}  // namespace howl::slow_change_test
