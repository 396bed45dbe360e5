#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/app/program.h"

namespace howl::family_questions_test {
namespace {

using Json = nlohmann::json;

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Json RunFamily(const std::string& config, const TemporaryFolder& folder, const std::string& more) {
  const ProgramResult run =
      RunHowl("family " + config + " --out " + folder.path().string() + " " + more);
  EXPECT_EQ(run.status, 0) << run.err;
  return Json::parse(ReadFile(folder.path() / "family.json"));
}

// The experiments that the family was drawn from reject none of it.
TEST(FamilyQuestions, NoMemberIsRejectedByItsOwnExperiments) {
  const TemporaryFolder folder;
  const Json json = RunFamily(Config("r228"), folder, "--falsify " + Config("r228"));
  const Json& falsified = json["falsified"];
  EXPECT_EQ(falsified["experiments"].size(), 6u);
  EXPECT_EQ(falsified["survive"], 1000);
  EXPECT_EQ(falsified["rejected"], 0);
  EXPECT_EQ(falsified["untested"], 0);
}

// Phase errors within the family lie within 0.5 degrees of the table: a table whose phase is moved
// by 0.5 degrees keeps about half of each experiment's range, by 1.1 degrees nothing.
TEST(FamilyQuestions, AMovedPhaseRejectsByThePhaseCondition) {
  const TemporaryFolder folder;
  const std::string text = ReadFile(Config("r228"));
  const auto half =
      folder.Write("half.yaml", Replaced(text, "phase_deg: -14.35", "phase_deg: -14.85"));
  const auto far =
      folder.Write("far.yaml", Replaced(text, "phase_deg: -14.35", "phase_deg: -15.45"));
  const Json some = RunFamily(Config("r228"), folder, "--falsify " + half.string())["falsified"];
  EXPECT_GT(some["survive"], 0);
  EXPECT_GT(some["rejected"], 0);
  const Json none = RunFamily(Config("r228"), folder, "--falsify " + far.string())["falsified"];
  EXPECT_EQ(none["survive"], 0);
  EXPECT_EQ(none["rejected_by"]["phase_tolerance_deg"], 1000);
}

TEST(FamilyQuestions, AdviceIsSortedAndItsSharesAreShares) {
  const TemporaryFolder folder;
  const Json advice = RunFamily(Config("r228"), folder, "--advise")["advice"];
  ASSERT_GT(advice.size(), 10u);
  double last = 0.0;
  for (const Json& one : advice) {
    const double left = one["expected_remaining"];
    EXPECT_GE(left, last);
    EXPECT_LE(left, 1.0 + 1e-12);
    last = left;
  }
  EXPECT_LT(advice.front()["expected_remaining"].get<double>(), 0.9);
}

// At the limit cycle the loop's gain is at least one for every reliable experiment, so that the
// rest state is unstable: its rightmost pole grows.
TEST(FamilyQuestions, RestStatesOfReliableExperimentsGrow) {
  const TemporaryFolder folder;
  const Json json = RunFamily(Config("r228"), folder, "");
  int checked = 0;
  for (const Json& one : json["predictions"]) {
    if (one["name"] != "growth_rate") continue;
    EXPECT_EQ(one["kind"], "sampled");
    EXPECT_EQ(one["members"], 60);
    if (one["experiment"] == "exp5" || one["experiment"] == "exp6") continue;
    EXPECT_GT(one["interval"][0].get<double>(), 0.0);
    ++checked;
  }
  EXPECT_EQ(checked, 4);
}

TEST(FamilyQuestions, MistakesAreTheUsers) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  EXPECT_EQ(RunHowl("family " + Config("r228") + out + " --falsify").status, 2);
  EXPECT_EQ(RunHowl("family " + Config("r228") + out + " --falsify nowhere.yaml").status, 2);
  EXPECT_EQ(RunHowl("family " + Config("r228") + out + " --save-every 0").status, 2);
}

// Three experiments with two modes, so that the search lasts long enough to be killed in it.
std::string TwoModesShort() {
  std::string text = ReadFile(Config("r228_two_modes"));
  const std::size_t from = text.find("  - {name: exp4");
  const std::size_t to = text.find("model:");
  EXPECT_NE(from, std::string::npos);
  text.erase(from, to - from);
  return Replaced(text, "members: 1000", "members: 100");
}

TEST(Family, KilledAtRandomAndRunAgainGivesTheSameResult) {
  const TemporaryFolder whole, killed;
  const auto config = whole.Write("short.yaml", TwoModesShort()).string();
  const auto start = std::chrono::steady_clock::now();
  RunFamily(config, whole, "--quiet");
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  std::mt19937 random(7);
  // Killed in the midst of a run, however fast the machine is.
  std::uniform_real_distribution<double> seconds(0.3 * taken.count(), 0.95 * taken.count());
  int killed_runs = 0;
  int with_state = 0;
  for (int k = 0; k < 6; ++k) {
    const std::string command = "timeout -s KILL " + std::to_string(seconds(random)) + " " +
                                HOWL_PROGRAM + " family " + config + " --quiet --save-every 0.05" +
                                " --out " + killed.path().string() + " >/dev/null 2>&1";
    const int raw = std::system(command.c_str());
    killed_runs += raw != 0 ? 1 : 0;
    with_state += std::filesystem::exists(killed.path() / "bounds.state") ? 1 : 0;
  }
  EXPECT_GT(killed_runs, 0);
  EXPECT_GT(with_state, 0);
  RunFamily(config, killed, "--quiet");
  for (const char* const name : {"family.json", "family.csv", "tradeoff.csv"}) {
    EXPECT_EQ(ReadFile(killed.path() / name), ReadFile(whole.path() / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(killed.path() / "bounds.state"));
}

}  // namespace
}  // namespace howl::family_questions_test
