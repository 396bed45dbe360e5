// What a diagnosis of records finds that a loop lacks, on simulated rigs whose loop is known.
#include "diagnosis/loop_budget/loop_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/forms/loop_item.h"
#include "diagnosis/loop_budget/forms/parameter_labels.h"
#include "diagnosis/loop_budget/trials/loop_starts.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::loop_budget_test {
namespace {

std::vector<LoopRecord> DuctsRecords() { return DuctsAt({1.2, 1.5, 1.8}); }

TEST(LoopBudget, OfTheRightLoopHasNothing) {
  const LoopDiagnosis found =
      DiagnoseLoops(DuctsRecords(), DuctsForm(),
                    Among({"extra_acoustic_mode", "delay_dispersion", "duct_noise",
                           "p_sensor_noise", "mains_hum", "external_tone"}));
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kNone);
  EXPECT_TRUE(found.diagnosis.budget->entries.empty());
  EXPECT_GT(found.diagnosis.probability_none, 0.5);
  // What is left are errors of the parameters.
  const Budget& budget = *found.diagnosis.budget;
  EXPECT_GT(budget.floor, 0.0);
  EXPECT_LT(budget.gap_left, 1.5 * budget.floor);
}

// A search that begins at one mode finds the second, whatever the base says of dampings.
TEST(LongLoopBudget, FindsASecondModeBesideASingleOne) {
  RecordLoopSpec spec;
  spec.modes = 1;
  spec.own_damping = false;
  const LoopDiagnosis found = DiagnoseLoops(DuctsRecords(), LeastForm(spec),
                                            Among({"extra_acoustic_mode", "mode_detuning"}));
  const Budget& budget = *found.diagnosis.budget;
  ASSERT_EQ(budget.entries.size(), 1u);
  EXPECT_EQ(budget.entries[0].item, "extra_acoustic_mode");
  EXPECT_EQ(budget.entries[0].experiments_better, 3u);
  ASSERT_EQ(budget.entries[0].parameters.size(), 2u);
  EXPECT_NEAR(budget.entries[0].parameters[0].value, 455.0, 5.0);
  EXPECT_EQ(found.best.structure.modes, 2);
  // Items are fitted at once on as many threads as there are: to the same bits as on one.
  LoopBudgetOptions alone = Among({"extra_acoustic_mode", "mode_detuning"});
  alone.threads = 1;
  const LoopDiagnosis again = DiagnoseLoops(DuctsRecords(), LeastForm(spec), alone);
  EXPECT_EQ(again.diagnosis.budget->gap_left, budget.gap_left);
  ASSERT_EQ(again.diagnosis.budget->entries.size(), 1u);
  EXPECT_EQ(again.diagnosis.budget->entries[0].lost_nats, budget.entries[0].lost_nats);
  EXPECT_EQ(again.acoustics.nats, found.acoustics.nats);
}

// The paper's acoustics for those of the duct: real residues, and the second mode at three times
// the first, where the duct has it at 2.3 times.
TEST(LoopBudget, FindsWhatTheAcousticsLack) {
  LoopForm base = DuctsForm();
  base.structure.ratio = 3.0;
  base.structure.complex_residues = false;
  const LoopDiagnosis found =
      DiagnoseLoops(DuctsRecords(), base, Among({"mode_detuning", "complex_residues"}));
  const Budget& budget = *found.diagnosis.budget;
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kEffect);
  ASSERT_EQ(budget.entries.size(), 2u);
  for (const BudgetEntry& entry : budget.entries) {
    EXPECT_GT(entry.lost_nats, 20.0) << entry.item;
    EXPECT_EQ(entry.experiments_better, 3u) << entry.item;
    EXPECT_GT(entry.lost_on_halves[0], 0.0) << entry.item;
    EXPECT_GT(entry.lost_on_halves[1], 0.0) << entry.item;
    EXPECT_LT(entry.gap_after, entry.gap_before) << entry.item;
    if (entry.item != "mode_detuning") continue;
    EXPECT_NEAR(entry.parameters[0].value, 455.0 / 200.0, 0.03);
  }
  EXPECT_LT(budget.gap_left, 0.45 * budget.gap_before);
}

// A flame that answers to another signal than the base's.
TEST(LoopBudget, FindsWhatDrivesTheFlame) {
  LoopForm base = DuctsForm();
  base.flame_input = FlameInput::kVelocity;
  const LoopDiagnosis found = DiagnoseLoops(
      DuctsRecords(), base, Among({"flame_input_pressure", "flame_input_pressure_rate"}));
  ASSERT_EQ(found.diagnosis.effect, "flame_input_pressure_rate");
  EXPECT_EQ(found.best.flame_input, FlameInput::kPressureRate);
  const EstimatedParameter& tau = found.diagnosis.budget->entries[0].parameters[0];
  EXPECT_NEAR(tau.value, 0.0033, 0.00005);
}

// Recorded q is q through a low-pass of first order.
TEST(LoopBudget, FindsInstrumentsOfQ) {
  constexpr double kCutoff_hz = 500.0;
  const std::vector<LoopRecord> records =
      DuctsAt({1.2, 1.5, 1.8}, [](Record* record) { LowPass(kCutoff_hz, record); });
  const LoopDiagnosis found = DiagnoseLoops(
      records, DuctsForm(), Among({"q_sensor_lowpass", "channel_skew", "crosstalk_p_to_q"}));
  ASSERT_FALSE(found.diagnosis.budget->entries.empty());
  const BudgetEntry& entry = found.diagnosis.budget->entries[0];
  EXPECT_EQ(entry.item, "q_sensor_lowpass");
  EXPECT_EQ(found.diagnosis.budget->entries.size(), 1u);
  EXPECT_NEAR(entry.parameters[0].value, kCutoff_hz, 0.03 * kCutoff_hz);
  EXPECT_LT(entry.parameters[0].high / entry.parameters[0].low, 1.1);
  EXPECT_GT(entry.lost_nats, 20.0);
}

bool Offered(const std::vector<LoopItem>& items, const std::string& id) {
  return std::ranges::find(items, id, &LoopItem::id) != items.end();
}

TEST(LoopItem, ComesAndGoes) {
  LoopForm base;
  base.structure.modes = 2;
  base.structure.ratio = 3.0;
  base.structure.own_damping = false;
  base.structure.complex_residues = false;
  base.structure.noise = LeastNoise();
  for (const LoopItem& item : LoopItems(base, base)) {
    const LoopForm with = With(base, item);
    // Hum may come in the other channel too, and modes as often as they pay.
    const bool again = IsHum(item.noise.source) || item.kind == LoopItemKind::kMode;
    EXPECT_EQ(Offered(LoopItems(with, base), item.id), again) << item.id;
    const LoopForm back = Without(with, item, base);
    EXPECT_EQ(back.flame_input, base.flame_input);
    EXPECT_EQ(back.structure.modes, base.structure.modes);
    EXPECT_EQ(back.structure.ratio, base.structure.ratio);
    EXPECT_EQ(back.structure.own_damping, base.structure.own_damping);
    EXPECT_EQ(back.structure.complex_residues, base.structure.complex_residues);
    EXPECT_EQ(back.structure.delay_spread, base.structure.delay_spread);
    EXPECT_EQ(back.structure.second_path, base.structure.second_path);
    EXPECT_EQ(back.structure.NoiseParameters(), base.structure.NoiseParameters());
  }
  // A further mode stays where the others are tied to one another again.
  const LoopItem own_damping{"own_damping", LoopItemKind::kOwnDamping};
  LoopForm free = With(base, own_damping);
  free = With(free, {"extra_acoustic_mode", LoopItemKind::kMode});
  EXPECT_EQ(free.structure.Frequencies(), 2);
  EXPECT_EQ(free.structure.Dampings(), 3);
  const LoopForm tied = Without(free, own_damping, base);
  EXPECT_EQ(tied.structure.modes, 3);
  EXPECT_EQ(tied.structure.Dampings(), 2);
}

// Where tied modes stand on what the loop lacked, a third of their places say, they begin anew at
// their own.
TEST(LoopStarts, TiedModesBeginAnew) {
  const LoopRecords records(DuctsAt({1.2, 1.8}), 0);
  LoopFit fit;
  fit.model = DuctsForm();
  fit.model.structure.ratio = 455.0 / 200.0;
  fit.model.structure.own_damping = false;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const RecordSpectra record = records.Whole(fit.model, e);
    const PointPrior prior = PriorOf(fit.model.structure, record);
    fit.fit.points.emplace_back().parameters =
        StartsOf(record, fit.model.structure, prior, 4, 1).front();
    fit.fit.points[e].parameters[0] = std::log(1.0 / 3.0);
  }
  const StartRows rows = Again(records, fit, 0);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0], ParametersOf(fit));
  for (std::size_t e = 0; e < records.size(); ++e) {
    const LoopPoint point =
        ToPoint(fit.model.structure, records.FlameTerms(fit.model.flame_input, e), rows[1][e]);
    EXPECT_NEAR(point.modes[0].omega * records.cycle_hz()[e], 200.0, 15.0);
  }
  fit.model = DuctsForm();
  EXPECT_EQ(Again(records, fit, 0).size(), 1u);
}

// Beside the paper's modes, which stay tied to one another.
TEST(LoopItem, FurtherModesHaveTheirOwnPlaces) {
  PointStructure structure;
  structure.modes = 3;
  structure.ratio = 3.0;
  structure.own_damping = false;
  structure.further_modes = 1;
  structure.noise = LeastNoise();
  LoopPoint point;
  point.modes = {{1.0, 0.1, 2.0}, {3.0, 0.1, 1.0}, {5.2, 0.02, 0.5}};
  for (LoopMode& mode : point.modes) mode.b = 0.1;
  point.path.tau = 1.0;
  point.flame = Eigen::VectorXd::Ones(2);
  for (const NoiseTerm& term : structure.noise) {
    point.noise.push_back(Eigen::VectorXd::Zero(term.coefficients));
  }
  const Eigen::VectorXd parameters = ToParameters(structure, point);
  const LoopPoint back = ToPoint(structure, 2, parameters);
  for (std::size_t k = 0; k < point.modes.size(); ++k) {
    EXPECT_NEAR(back.modes[k].omega, point.modes[k].omega, 1e-15);
    EXPECT_NEAR(back.modes[k].xi, point.modes[k].xi, 1e-15);
    EXPECT_EQ(back.modes[k].a, point.modes[k].a);
  }
  const std::vector<std::string> labels = ParameterLabels(structure, 2);
  EXPECT_EQ(std::vector<std::string>(labels.begin(), labels.begin() + 5),
            (std::vector<std::string>{"omega0", "omega2", "xi0", "xi2", "a0"}));
}

}  // namespace
}  // namespace howl::loop_budget_test
