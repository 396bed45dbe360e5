// What samples show before any loop is fitted to them.
#include "diagnosis/loop_budget/sample_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::sample_facts_test {
namespace {

std::vector<LoopRecord> Ducts() { return DuctsAt({1.2, 1.5, 1.8}); }

void Clip(double of_largest, std::vector<double>* signal) {
  const double level = of_largest * std::ranges::max(*signal);
  for (double& value : *signal) value = std::clamp(value, -level, level);
}

void Quantise(double steps_to_largest, std::vector<double>* signal) {
  const double step = std::ranges::max(*signal) / steps_to_largest;
  for (double& value : *signal) value = step * std::round(value / step);
}

TEST(SampleFacts, AreNoneOfASimulatedLoop) { EXPECT_TRUE(SampleFactsOf(Ducts()).empty()); }

TEST(SampleFacts, AreOfMoreThanHalfOfTheRecords) {
  std::vector<LoopRecord> records = Ducts();
  Clip(0.6, &records[0].record.heat_release);
  EXPECT_TRUE(SampleFactsOf(records).empty());
  Clip(0.6, &records[2].record.heat_release);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].effect, "q_clipping");
  EXPECT_EQ(facts[0].experiments, 2u);
  double share = 0.0;
  for (const std::size_t e : {0, 2}) {
    const std::vector<double>& q = records[e].record.heat_release;
    const auto at_ends = static_cast<double>(std::ranges::count(q, std::ranges::max(q)) +
                                             std::ranges::count(q, std::ranges::min(q)));
    share += 0.5 * at_ends / static_cast<double>(q.size());
  }
  EXPECT_NEAR(facts[0].value, share, 1e-12);
  EXPECT_EQ(SampleFactsOf(records, {"p_clipping"}).size(), 1u);
  EXPECT_TRUE(SampleFactsOf(records, {"q_clipping"}).empty());
}

// A loop that lacks nothing but what the clipping imitates: nothing else is named.
TEST(SampleFacts, ClippingIsTheVerdict) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) Clip(0.6, &each.record.pressure);
  const LoopDiagnosis found = DiagnoseLoops(records, DuctsForm(), Among({"complex_residues"}));
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(found.diagnosis.effect, "p_clipping");
  ASSERT_EQ(found.diagnosis.candidates.size(), 1u);
  EXPECT_EQ(found.diagnosis.candidates[0].effect, "p_clipping");
  EXPECT_TRUE(found.diagnosis.budget->entries.empty());
  EXPECT_NE(found.diagnosis.advice.find("record again"), std::string::npos);
}

TEST(SampleFacts, SoAreFewLevels) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) Quantise(12.0, &each.record.pressure);
  LoopForm base = DuctsForm();
  base.structure.complex_residues = false;
  const LoopDiagnosis found = DiagnoseLoops(records, base, Among({"complex_residues"}));
  EXPECT_EQ(found.diagnosis.effect, "quantisation");
  ASSERT_EQ(found.diagnosis.budget->seen_in_samples.size(), 1u);
  EXPECT_NEAR(found.diagnosis.budget->seen_in_samples[0].value, 24.0, 2.0);
  EXPECT_TRUE(found.diagnosis.budget->entries.empty());
  EXPECT_EQ(found.diagnosis.probability_none, 0.0);
  // Nothing else was looked for, and one cause in twenty-one has another beside it.
  EXPECT_NEAR(found.diagnosis.probability_unknown, 1.0 / 21.0, 1e-12);
  EXPECT_NEAR(found.diagnosis.candidates[0].probability, 20.0 / 21.0, 1e-12);
}

TEST(SampleFacts, AreAllThatTheRecordsShow) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) {
    Clip(0.6, &each.record.heat_release);
    Quantise(12.0, &each.record.pressure);
  }
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 2u);
  EXPECT_EQ(facts[0].effect, "q_clipping");
  EXPECT_EQ(facts[1].effect, "quantisation");
  EXPECT_FALSE(facts[1].is_noise);
}

// Of 100 levels the steps are the noise of p, which the base has: the rest is looked for beside it.
TEST(SampleFacts, FineStepsLeaveTheRestToBeFound) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) Quantise(50.0, &each.record.pressure);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_TRUE(facts[0].is_noise);
  EXPECT_NEAR(facts[0].value, 100.0, 8.0);
  const LoopDiagnosis alone = DiagnoseLoops(records, DuctsForm(), Among({"complex_residues"}));
  EXPECT_EQ(alone.diagnosis.effect, "quantisation");
  LoopForm base = DuctsForm();
  base.structure.complex_residues = false;
  const LoopDiagnosis both = DiagnoseLoops(records, base, Among({"complex_residues"}));
  EXPECT_EQ(both.diagnosis.effect, "quantisation+complex_residues");
}

}  // namespace
}  // namespace howl::sample_facts_test
