// Two modes through the program: the branch, the second crossing, and what is said of both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.h"

namespace howl::two_modes_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

// r228.yaml with `modes: 2` and nothing else.
std::string TwoModes(const std::string& further = "") {
  return ReadFile(Config("r228")) + "model: {modes: 2}\n" + further;
}

TEST(TwoModes, StayOnThePapersBranchAndSayWhatTheOtherCosts) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  const std::string config = folder.Write("two.yaml", TwoModes()).string();
  const ProgramResult fit = RunHowl("fit " + config + out);
  ASSERT_EQ(fit.status, 0) << fit.err;
  const Json solution = Json::parse(ReadFile(folder.path() / "solution.json"));
  for (const Json& each : solution["experiments"]) {
    EXPECT_GT(each["omega_hz"].get<double>(), 0.9 * each["frequency_hz"].get<double>());
    EXPECT_LT(each["second_mode_share"].get<double>(), 0.12);
    EXPECT_FALSE(each["crossings"].empty());
  }
  const Json& branches = solution["branches"];
  ASSERT_TRUE(branches["data_prefer_other"].get<bool>());
  EXPECT_LT(branches["other"]["cost"].get<double>(), branches["fit"]["cost"].get<double>());
  EXPECT_THAT(fit.out, HasSubstr("the data prefer the other branch"));
  EXPECT_THAT(fit.out, HasSubstr("crossing Hz"));
}

TEST(TwoModes, WithoutTheResidualTheFitSaysThatItIsOnAnotherBranch) {
  const TemporaryFolder folder;
  const std::string config =
      folder.Write("free.yaml", TwoModes("residuals: {second_mode_minor: off}\n")).string();
  const ProgramResult fit = RunHowl("fit " + config + " --out " + folder.path().string());
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("the second mode carries the cycle"));
}

TEST(TwoModes, OneModeHasCrossingsAndNoBranch) {
  const TemporaryFolder folder;
  const ProgramResult fit = RunHowl("fit " + Config("r228") + " --out " + folder.path().string());
  ASSERT_EQ(fit.status, 0) << fit.err;
  const Json solution = Json::parse(ReadFile(folder.path() / "solution.json"));
  EXPECT_FALSE(solution.contains("branches"));
  const Json& crossing = solution["experiments"][0]["crossings"][0];
  EXPECT_NEAR(crossing["observed_hz"].get<double>(), 219.9, 1e-9);
  EXPECT_NEAR(crossing["frequency_hz"].get<double>(), 219.9, 1.0);
  EXPECT_THAT(fit.out, Not(HasSubstr("branch")));
}

TEST(TwoModes, ReportTakesTheNewFields) {
  const TemporaryFolder folder;
  const std::string config = folder.Write("two.yaml", TwoModes()).string();
  ASSERT_EQ(RunHowl("fit " + config + " --out " + folder.path().string()).status, 0);
  const ProgramResult report = RunHowl("report " + folder.path().string());
  EXPECT_EQ(report.status, 0) << report.err;
}

}  // namespace
}  // namespace howl::two_modes_test
