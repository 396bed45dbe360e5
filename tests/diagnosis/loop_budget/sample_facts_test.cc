// What samples show before any loop is fitted to them.
#include "diagnosis/loop_budget/sample_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/health/stuck_samples.h"
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

// Behind the saturation noise was added: of p, whose density a loop does not cut off. A flame may.
TEST(SampleFacts, NoiseBehindTheRangeHidesNoClippingOfPressure) {
  std::vector<LoopRecord> records = Ducts();
  std::mt19937_64 random(3);
  for (LoopRecord& each : records) {
    for (std::vector<double>* signal : {&each.record.pressure, &each.record.heat_release}) {
      Clip(0.7, signal);
      std::normal_distribution<double> noise(0.0, 2e-3 * std::ranges::max(*signal));
      for (double& value : *signal) value += noise(random);
    }
  }
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].effect, "p_clipping");
  EXPECT_GT(facts[0].value, 0.02);
  EXPECT_FALSE(facts[0].rest_can_be_found);
  EXPECT_TRUE(SampleFactsOf(records, {"p_clipping"}).empty());
}

// Of q nothing else is looked for.
TEST(SampleFacts, ClippingOfHeatReleaseIsTheVerdict) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) Clip(0.6, &each.record.heat_release);
  const LoopDiagnosis found = DiagnoseLoops(records, DuctsForm(), Among({"complex_residues"}));
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(found.diagnosis.effect, "q_clipping");
  ASSERT_EQ(found.diagnosis.candidates.size(), 1u);
  EXPECT_EQ(found.diagnosis.candidates[0].effect, "q_clipping");
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
  EXPECT_FALSE(facts[1].rest_can_be_found);
}

// The fact alone where the loop is right, and what the loop lacks beside it.
void ExpectBesideResidues(const std::vector<LoopRecord>& records, const std::string& fact) {
  const LoopDiagnosis alone = DiagnoseLoops(records, DuctsForm(), Among({"complex_residues"}));
  EXPECT_EQ(alone.diagnosis.effect, fact);
  LoopForm base = DuctsForm();
  base.structure.complex_residues = false;
  const LoopDiagnosis both = DiagnoseLoops(records, base, Among({"complex_residues"}));
  EXPECT_EQ(both.diagnosis.effect, fact + "+complex_residues");
}

// What q tells of a clipped p leaves the loop as it is, and the rest to be found.
TEST(SampleFacts, ClippingOfPressureLeavesTheRestToBeFound) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) Clip(0.7, &each.record.pressure);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].effect, "p_clipping");
  EXPECT_TRUE(facts[0].rest_can_be_found);
  ExpectBesideResidues(records, "p_clipping");
}

TEST(SampleFacts, WhereMostIsClippedTheRestIsNotEnough) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) Clip(0.2, &each.record.pressure);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].effect, "p_clipping");
  EXPECT_FALSE(facts[0].rest_can_be_found);
}

// Of 100 levels the steps are the noise of p, which the base has: the rest is looked for beside it.
TEST(SampleFacts, FineStepsLeaveTheRestToBeFound) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) Quantise(50.0, &each.record.pressure);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_TRUE(facts[0].rest_can_be_found);
  EXPECT_NEAR(facts[0].value, 100.0, 8.0);
  ExpectBesideResidues(records, "quantisation");
}

// Stands of `length` samples, one in four hundred begins one.
void StandStill(std::size_t length, std::vector<double>* signal) {
  std::mt19937_64 random(7);
  for (std::size_t t = 1; t + length < signal->size(); ++t) {
    if (random() % 400 != 0) continue;
    std::fill_n(signal->begin() + static_cast<std::ptrdiff_t>(t), length, (*signal)[t - 1]);
    t += length;
  }
}

TEST(SampleFacts, StuckSamplesLeaveTheRestToBeFound) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) StandStill(20, &each.record.pressure);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].effect, "p_dropouts");
  EXPECT_EQ(facts[0].experiments, 3u);
  EXPECT_TRUE(facts[0].rest_can_be_found);
  ExpectBesideResidues(records, "p_dropouts");
}

TEST(SampleFacts, WhereMostIsStuckTheRestIsNotEnough) {
  std::vector<LoopRecord> records = Ducts();
  for (LoopRecord& each : records) StandStill(300, &each.record.heat_release);
  EXPECT_GT(ShareStuck(records[0].record.heat_release), kMostStuck);
  const std::vector<SampleFact> facts = SampleFactsOf(records);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].effect, "q_dropouts");
  EXPECT_FALSE(facts[0].rest_can_be_found);
  const std::vector<LoopRecord> as_they_are = WithStuckSamplesFilled(records, {}, 1);
  EXPECT_EQ(as_they_are[0].record.heat_release, records[0].record.heat_release);
}

TEST(SampleFacts, StuckSamplesThatAreWithheldStay) {
  std::vector<LoopRecord> records = Ducts();
  StandStill(20, &records[1].record.pressure);
  const std::vector<LoopRecord> kept = WithStuckSamplesFilled(records, {"p_dropouts"}, 1);
  EXPECT_EQ(kept[1].record.pressure, records[1].record.pressure);
  const std::vector<LoopRecord> filled = WithStuckSamplesFilled(records, {"q_dropouts"}, 1);
  EXPECT_EQ(filled[0].record.pressure, records[0].record.pressure);
  EXPECT_NE(filled[1].record.pressure, records[1].record.pressure);
}

}  // namespace
}  // namespace howl::sample_facts_test
