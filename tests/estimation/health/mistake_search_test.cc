// Each mistake, made in a right table, is named; a right table is never accused.
#include "estimation/health/mistake_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/estimation/health/right_rig.h"
#include "tests/r228.h"

namespace howl::mistake_search_test {
namespace {

using Table = std::vector<Experiment>;

Health Search(const Table& table, bool one_tau = false) {
  ModelSpec model = DefaultModelSpec();
  if (one_tau) model[ParameterKind::kTau].scope = ParameterScope::kShared;
  const JointProblem problem(table, model, DefaultResidualSet());
  const JointFit fit = SolveJoint(problem, {}, 1, 2);
  return FindMistakes(problem, DefaultResidualSet(), fit, {.threads = 2});
}

struct Made {
  const char* id;
  const char* experiment;  // empty: in all
  std::function<void(Experiment&)> make;
  bool one_tau = false;  // shared by all experiments: the prior alone does not see it
};

void PrintTo(const Made& made, std::ostream* out) { *out << made.id << " " << made.experiment; }

class MistakeMade : public testing::TestWithParam<Made> {};

TEST_P(MistakeMade, IsNamed) {
  const Made& made = GetParam();
  for (const unsigned seed : {1U, 2U, 3U}) {
    Table table = RightTable(seed);
    for (Experiment& experiment : table) {
      if (*made.experiment == '\0' || experiment.name == made.experiment) made.make(experiment);
    }
    const Health health = Search(table, made.one_tau);
    const bool named = std::ranges::any_of(health, [&](const Finding& finding) {
      return finding.subject == made.id && finding.experiment == made.experiment;
    });
    std::string found;
    for (const Finding& finding : health) found += finding.text + "\n";
    EXPECT_TRUE(named) << found;
    // What cannot be told from it may stand beside it, and no more.
    EXPECT_LE(health.size(), 2U) << found;
  }
}

// Written out here anew, from what the mistake is, not from the code that undoes it.
const Made kMade[] = {
    {"inverted", "", [](Experiment& e) { e.phase_deg += e.phase_deg < 0.0 ? 180.0 : -180.0; }},
    {"inverted", "exp3", [](Experiment& e) { e.phase_deg += 180.0; }},
    {"phase_sign", "", [](Experiment& e) { e.phase_deg *= -1.0; }},
    {"p_and_q_swapped", "",
     [](Experiment& e) {
       e.phase_deg *= -1.0;
       e.gain = 1.0 / e.gain;
     }},
    {"gain_inverted", "", [](Experiment& e) { e.gain = 1.0 / e.gain; }},
    {"phase_in_radians", "", [](Experiment& e) { e.phase_deg *= std::acos(-1.0) / 180.0; }, true},
    {"frequency_in_khz", "", [](Experiment& e) { e.frequency_hz /= 1000.0; }},
    {"frequency_in_khz", "exp2", [](Experiment& e) { e.frequency_hz /= 1000.0; }},
    {"frequency_in_rad_per_s", "exp4",
     [](Experiment& e) { e.frequency_hz *= 2.0 * std::acos(-1.0); }},
    {"flame_slope_unit", "", [](Experiment& e) { *e.flame_slope /= 1000.0; }},
};

INSTANTIATE_TEST_SUITE_P(, MistakeMade, testing::ValuesIn(kMade));

TEST(MistakeSearch, ALoopGainOfThousandsIsAUnit) {
  Table table = RightTable(1);
  for (Experiment& e : table) *e.flame_slope *= 1e4;
  const Health health = Search(table);
  ASSERT_EQ(health.size(), table.size());
  for (const Finding& finding : health) {
    EXPECT_EQ(finding.subject, "flame_slope_unit");
    EXPECT_NEAR(finding.value / 1e4, kRightLoopGain, 0.1);
  }
}

TEST(MistakeSearch, ARecordsRateThatIsWrongByTwoIsNamed) {
  Table table = RightTable(1);
  // Sampled at half the rate that was told: time, 1 / f and the slope are halved.
  table[1].frequency_hz *= 2.0;
  *table[1].flame_slope /= 2.0;
  const JointProblem problem(table, DefaultModelSpec(), DefaultResidualSet());
  const JointFit fit = SolveJoint(problem, {}, 1, 2);
  std::vector<std::string> recorded;
  for (const Experiment& e : table) recorded.push_back(e.name);
  const Health health =
      FindMistakes(problem, DefaultResidualSet(), fit, {.recorded = recorded, .threads = 2});
  ASSERT_EQ(health.size(), 1U);
  EXPECT_EQ(health[0].subject, "sampling_rate");
  EXPECT_EQ(health[0].experiment, "exp2");
}

TEST(MistakeSearch, PublishedTablesAreNotAccused) {
  EXPECT_THAT(Search(R228()), testing::IsEmpty());
  EXPECT_THAT(Search(R228Reliable()), testing::IsEmpty());
}

TEST(MistakeSearch, RightTablesAreNotAccused) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Health health = Search(RightTable(seed));
    EXPECT_THAT(health, testing::IsEmpty()) << seed << ": " << health.front().text;
  }
}

// Errors of ten times what the fit expects make a bad fit, and are no mistake of these.
TEST(MistakeSearch, ABadTableIsNotAccused) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int draw = 0; draw < 10; ++draw) {
    Table table = RightTable(0);
    for (Experiment& e : table) {
      e.frequency_hz *= 1.0 + 0.1 * normal(random);
      e.phase_deg += 8.0 * normal(random);
    }
    const Health health = Search(table);
    EXPECT_THAT(health, testing::IsEmpty()) << draw << ": " << health.front().text;
  }
}

}  // namespace
}  // namespace howl::mistake_search_test
