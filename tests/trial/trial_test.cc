// The blind trial's plan and scores, on cases worked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "trial/case_plan.h"
#include "trial/score.h"

namespace howl::trial_test {
namespace {

std::vector<RigEffect> ThreeEffects() {
  return {{"hum", "p_instrument or q_instrument", true, "rel", {0.01, 0.1, 1.0}},
          {"lag", "flame", true, "cutoff_hz", {4000, 1000, 250}},
          {"x_gremlin", "delay", false, "rel", {1, 2, 4}}};
}

CaseOutcome Case(std::vector<WithheldEffect> withheld, const std::string& kind,
                 const std::string& effect, std::map<std::string, double> probability) {
  CaseOutcome one;
  one.withheld = std::move(withheld);
  one.answered = true;
  one.kind = kind;
  one.effect = effect;
  one.probability = std::move(probability);
  one.gap_before = 1.0;
  one.gap_after = 1.0;
  return one;
}

const WithheldEffect kHum = {"hum", "q_instrument", true, 0.55};
const WithheldEffect kLag = {"lag", "flame", true, 0.85};
const WithheldEffect kGremlin = {"x_gremlin", "delay", false, 0.85};

// Newcombe (1998), Statistics in Medicine 17, table I: 81 of 263 by Wilson's method.
TEST(Tally, HasWilsonsInterval) {
  const Tally tally{81, 263};
  EXPECT_NEAR(tally.Low(), 0.2553, 5e-5);
  EXPECT_NEAR(tally.High(), 0.3662, 5e-5);
  const Tally none{0, 20};
  EXPECT_NEAR(none.Low(), 0.0, 1e-12);
  EXPECT_NEAR(none.High(), 0.1611, 5e-5);
  EXPECT_TRUE(std::isnan(Tally{}.Share()));
}

TEST(CasePlan, IsBalancedAndInRandomOrder) {
  const auto plans = PlanCases({.cases = 200,
                                .effects = {"catalogue", "none", "outside", "pairs"},
                                .severities = {0.25, 0.55, 0.85},
                                .seed = 4},
                               ThreeEffects());
  ASSERT_EQ(plans.size(), 200u);
  std::map<std::string, int> count;
  std::map<std::pair<std::string, double>, int> cells;
  std::set<std::uint64_t> seeds;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    std::string label = plans[i].effects.empty() ? "none" : "";
    for (const std::string& effect : plans[i].effects) label += effect;
    ++count[label];
    ++cells[{label, plans[i].severity}];
    seeds.insert(plans[i].rig_seed);
    EXPECT_FALSE(plans[i].name.empty());
  }
  EXPECT_EQ(seeds.size(), plans.size());
  EXPECT_EQ(count, (std::map<std::string, int>{
                       {"none", 30}, {"hum", 60}, {"lag", 60}, {"x_gremlin", 30}, {"humlag", 20}}));
  for (const double severity : {0.25, 0.55, 0.85}) {
    EXPECT_EQ((cells[{"hum", severity}]), 20);
    EXPECT_EQ((cells[{"lag", severity}]), 20);
  }
  // The order says nothing: the first tenth has more than one kind.
  std::set<std::size_t> kinds;
  for (std::size_t i = 0; i < 20; ++i) kinds.insert(plans[i].effects.size());
  EXPECT_EQ(kinds.size(), 3u);
}

TEST(CasePlan, DependsOnItsSeedAlone) {
  TrialOptions options{
      .cases = 12, .effects = {"hum", "lag+hum"}, .severities = {0.25, 0.55}, .seed = 4};
  const auto first = PlanCases(options, ThreeEffects());
  const auto again = PlanCases(options, ThreeEffects());
  options.seed = 5;
  const auto other = PlanCases(options, ThreeEffects());
  bool differs = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].effects, again[i].effects);
    EXPECT_EQ(first[i].rig_seed, again[i].rig_seed);
    differs = differs || first[i].effects != other[i].effects;
  }
  EXPECT_TRUE(differs);
  options.effects = {"hmu"};
  EXPECT_THROW(PlanCases(options, ThreeEffects()), std::invalid_argument);
}

TEST(Score, CountsAsByHand) {
  std::vector<CaseOutcome> cases = {
      Case({}, "none", "", {{"none", 0.9}, {"hum", 0.1}}),
      Case({}, "effect", "hum", {{"none", 0.25}, {"hum", 0.75}}),
      Case({}, "unknown", "", {{"none", 0.2}, {"unknown", 0.8}}),
      Case({kHum}, "effect", "hum", {{"hum", 0.5}, {"lag", 0.5}}),
      Case({kLag}, "effect", "hum", {{"hum", 0.75}, {"lag", 0.25}}),
      Case({kLag}, "unknown", "", {{"unknown", 1.0}}),
      Case({kGremlin}, "unknown", "", {{"unknown", 0.9}, {"lag", 0.1}}),
      Case({kGremlin}, "effect", "lag", {{"lag", 1.0}}),
      Case({kHum, kLag}, "effect", "hum", {{"hum", 1.0}}),
      Case({kHum, kLag}, "effect", "lag+hum", {{"lag+hum", 1.0}})};
  cases[3].blocks = {"q_instrument"};
  cases[4].indistinguishable = {"lag"};
  cases[4].blocks = {"q_instrument", "flame"};
  const ScoreSheet sheet = Score(cases, ThreeEffects());
  const MethodScore& score = sheet.howl;
  EXPECT_EQ(score.false_alarms.right, 2);
  EXPECT_EQ(score.false_alarms.total, 3);
  EXPECT_EQ(score.accused.right, 1);
  EXPECT_EQ(score.catalogue.named.right, 1);
  EXPECT_EQ(score.catalogue.named.total, 3);
  EXPECT_EQ(score.catalogue.in_class.right, 2);
  EXPECT_EQ(score.catalogue.block.right, 1);
  EXPECT_EQ(score.by_severity.at(0.85).in_class.right, 1);
  EXPECT_EQ(score.by_severity.at(0.85).in_class.total, 2);
  EXPECT_EQ(score.false_unknowns.right, 1);
  EXPECT_EQ(score.unknown_recall.right, 1);
  EXPECT_EQ(score.unknown_recall.total, 2);
  EXPECT_EQ(score.pairs_one_named.right, 1);
  EXPECT_EQ(score.pairs_both_named.right, 1);
  EXPECT_EQ(sheet.confusion.rows,
            (std::vector<std::string>{"(two effects)", "hum", "lag", "none", "x_gremlin"}));
  // -ln p, at least 0.001, over the eight cases with at most one effect.
  const double log_score = -(std::log(0.9) + std::log(0.25) + std::log(0.2) + std::log(0.5) +
                             std::log(0.25) + std::log(0.001) + std::log(0.9) + std::log(0.001));
  EXPECT_NEAR(score.log_score, log_score / 8.0, 1e-12);
  const double brier = 0.02 + 1.125 + 1.28 + 0.5 + 1.125 + 2.0 + 0.02 + 2.0;
  EXPECT_NEAR(score.brier, brier / 8.0, 1e-12);
}

// A class of four is no answer.
TEST(Score, LargeClassesDoNotCount) {
  CaseOutcome one = Case({kLag}, "effect", "hum", {});
  one.indistinguishable = {"lag", "a"};
  EXPECT_TRUE(IsInClass(one));
  one.indistinguishable.push_back("b");
  EXPECT_FALSE(IsInClass(one));
}

TEST(Score, ReliabilityHasItsBins) {
  std::vector<CaseOutcome> cases;
  for (int i = 0; i < 10; ++i) {
    cases.push_back(Case({}, "none", "", {{"none", 0.95}, {"hum", 0.05}}));
    cases.push_back(Case(i < 5 ? std::vector<WithheldEffect>{kHum} : std::vector<WithheldEffect>{},
                         "effect", "hum", {{"none", 0.45}, {"hum", 0.55}}));
  }
  const MethodScore score = Score(cases, ThreeEffects()).howl;
  int total = 0;
  for (const ReliabilityBin& bin : score.reliability) total += bin.right.total;
  EXPECT_EQ(total, 20);
  EXPECT_EQ(score.reliability[2].right.total, 10);
  EXPECT_EQ(score.reliability[2].right.right, 5);
  EXPECT_NEAR(score.reliability[2].mean_probability, 0.55, 1e-12);
  EXPECT_EQ(score.reliability[4].right.right, 10);
}

// Two effects count in either order, and one alone is wrong where two were withheld.
TEST(Score, ReliabilityCountsTwoEffectsToo) {
  const std::vector<CaseOutcome> cases = {
      Case({kHum, kLag}, "effect", "lag+hum", {{"lag+hum", 0.9}, {"unknown", 0.1}}),
      Case({kHum, kLag}, "effect", "hum", {{"hum", 0.9}, {"unknown", 0.1}}),
      Case({kHum, kLag}, "unknown", "", {{"hum", 0.3}, {"unknown", 0.7}})};
  const MethodScore score = Score(cases, ThreeEffects()).howl;
  EXPECT_EQ(score.reliability[4].right.total, 2);
  EXPECT_EQ(score.reliability[4].right.right, 1);
  EXPECT_EQ(score.reliability[3].right.total, 1);
  EXPECT_EQ(score.reliability[3].right.right, 0);
  EXPECT_EQ(score.by_answer.at("effect").total, 2);
  EXPECT_EQ(score.by_answer.at("effect").right, 1);
  EXPECT_EQ(score.by_answer.at("unknown").right, 0);
}

TEST(Score, ShrinkageIsOverTheOracles) {
  std::vector<CaseOutcome> cases;
  for (const double after : {0.2, 0.4, 0.6}) {
    CaseOutcome one = Case({kHum}, "effect", "hum", {});
    one.gap_before = 2.0;
    one.gap_after = after;
    one.candidates = {{"hum", 0.4, 0.8, 10.0, 12.0}};
    cases.push_back(one);
  }
  EXPECT_NEAR(Score(cases, ThreeEffects()).howl.median_shrinkage_over_oracle, 1.0, 1e-12);
}

TEST(Rivals, AnswerWithoutThought) {
  CaseOutcome one = Case({kHum}, "unknown", "", {});
  one.candidates = {{"lag", 0.7, 0.3, -1.0, 9.0}, {"hum", 0.5, 0.5, std::log(3.0), 6.0}};
  EXPECT_EQ(AlwaysNone(one).AnswerName(), "none");
  EXPECT_EQ(LargestGain(one, ThreeEffects()).AnswerName(), "lag");
  const CaseOutcome bic = LeastBic(one, ThreeEffects());
  EXPECT_EQ(bic.AnswerName(), "hum");
  // Evidence ratios 3 : e^-1 : 1.
  EXPECT_NEAR(bic.probability.at("hum"), 3.0 / (4.0 + std::exp(-1.0)), 1e-12);
  EXPECT_TRUE(IsRightBlock(bic));
  one.candidates[1].gain = -0.1;
  EXPECT_EQ(LeastBic(one, ThreeEffects()).AnswerName(), "none");
}

// Effects found from a known severity on: the interval covers it as often as it says, and few cases
// resolve nothing.
TEST(Power, FindsTheKnownThreshold) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  const double width = 0.05;
  int covered = 0;
  int total = 0;
  for (int round = 0; round < 60; ++round) {
    const double threshold = 0.35 + 0.4 * uniform(random);
    const double truth = threshold + width * std::log(9.0);
    std::vector<CaseOutcome> cases;
    for (int i = 0; i < 40; ++i) {
      WithheldEffect lag = kLag;
      lag.severity = uniform(random);
      const double p = 1.0 / (1.0 + std::exp(-(lag.severity - threshold) / width));
      const bool found = uniform(random) < p;
      cases.push_back(Case({lag}, found ? "effect" : "none", found ? "lag" : "", {}));
    }
    const std::vector<EffectPower> power = ComputePower(cases, ThreeEffects());
    ASSERT_EQ(power.size(), 1u);
    covered += power[0].severity_low <= truth && truth <= power[0].severity_high ? 1 : 0;
    ++total;
    if (power[0].resolved) {
      EXPECT_NEAR(power[0].severity, truth, 0.25);
      // The size falls as the severity rises: 250 Hz is large.
      EXPECT_LT(power[0].size_high, power[0].size_low);
    }
  }
  // 90 % of 60, less three standard deviations.
  EXPECT_GE(covered, 47);
  const std::vector<CaseOutcome> two = {Case({kLag}, "effect", "lag", {}),
                                        Case({kLag}, "effect", "lag", {})};
  EXPECT_FALSE(ComputePower(two, ThreeEffects())[0].resolved);
}

}  // namespace
}  // namespace howl::trial_test
