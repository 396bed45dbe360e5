// howl predict --map and --without as a user gives them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/app/program.h"

namespace howl::predict_map_test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

ProgramResult Predict(const std::string& config, const TemporaryFolder& folder,
                      const std::string& more) {
  return RunHowl("predict " + config + " --out " + (folder.path() / "out").string() + " " + more);
}

std::vector<std::vector<std::string>> Rows(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

TEST(PredictMap, ARowForEachPointAndTheMembersOnIt) {
  const TemporaryFolder folder;
  const ProgramResult run =
      Predict(Config("r228_reliable"), folder,
              "--map phi:tau_s --map-x 0.49:0.56:0.01 --map-y 0.002:0.005:0.00025");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("map: growth rate over phi 0.4900 .. 0.5600 and tau_s 0.002000"));
  const auto rows = Rows(ReadFile(folder.path() / "out" / "prediction_map.csv"));
  ASSERT_EQ(rows.size(), 1u + 8u * 13u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"phi", "tau_s", "growth_rate_1_s", "lo", "hi",
                                               "share_unstable", "members"}));
  EXPECT_EQ(rows[1][0], rows[9][0]);  // x within y
  EXPECT_NE(rows[1][1], rows[9][1]);
  std::size_t unstable = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const double lo = std::stod(rows[k][3]), hi = std::stod(rows[k][4]);
    EXPECT_LE(lo, std::stod(rows[k][2]));
    EXPECT_GE(hi, std::stod(rows[k][2]));
    if (lo > 0.0) {
      ++unstable;
      EXPECT_GE(std::stod(rows[k][5]), 0.97);
    }
  }
  const Json json = Json::parse(ReadFile(folder.path() / "out" / "prediction.json"));
  const Json& map = json["map"];
  EXPECT_EQ(map["file"], "prediction_map.csv");
  EXPECT_EQ(map["x"]["quantity"], "phi");
  EXPECT_EQ(map["y"]["values"], 13);
  EXPECT_TRUE(map["phi"].is_null());
  EXPECT_EQ(map["unstable"], unstable);
  EXPECT_GT(unstable, 0u);
  EXPECT_GT(map["stable"], 0);
  // Without --at the points are the measured ones, and each has the members' own delay.
  ASSERT_EQ(json["points"].size(), 4u);
  ASSERT_EQ(map["members"].size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(json["points"][k]["status"], "measured");
    EXPECT_EQ(map["members"][k]["x"]["value"], json["points"][k]["phi"]);
    const Json& own = map["members"][k]["y"];
    const Json& guaranteed = json["points"][k]["guaranteed"]["tau_s"];
    EXPECT_GE(own["lo"], guaranteed[0]);
    EXPECT_LE(own["hi"], guaranteed[1]);
  }
  // Without a map the file of the last one does not stay.
  ASSERT_EQ(Predict(Config("r228_reliable"), folder, "--at 0.52 --quiet").status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "prediction_map.csv"));
  EXPECT_FALSE(Json::parse(ReadFile(folder.path() / "out" / "prediction.json")).contains("map"));
}

TEST(PredictMap, TwoParametersAtOnePointOnAnyNumberOfThreads) {
  const TemporaryFolder one, two;
  const std::string more = "--map xi:tau_s --at 0.53 --map-x 0.02:0.2:0.06 --quiet --threads ";
  ASSERT_EQ(Predict(Config("r228_reliable"), one, more + "1").status, 0);
  ASSERT_EQ(Predict(Config("r228_reliable"), two, more + "2").status, 0);
  const std::string csv = ReadFile(one.path() / "out" / "prediction_map.csv");
  EXPECT_EQ(csv, ReadFile(two.path() / "out" / "prediction_map.csv"));
  EXPECT_EQ(Rows(csv).size(), 1u + 4u * 41u);
  const Json json = Json::parse(ReadFile(one.path() / "out" / "prediction.json"));
  EXPECT_EQ(json["map"]["phi"], 0.53);
}

TEST(PredictMap, MistakesAreTheUsers) {
  const TemporaryFolder folder;
  const auto fails = [&](const std::string& more, const std::string& what) {
    const ProgramResult run = Predict(Config("r228_reliable"), folder, more);
    EXPECT_EQ(run.status, 2) << more;
    EXPECT_THAT(run.err, HasSubstr(what)) << more;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  fails("--map phi", "--map: phi, expected two of phi, omega_hz, xi, N, tau_s, flame_slope");
  fails("--map phi:tau", "--map: phi:tau, expected two of");
  fails("--map phi:M", "--map: phi:M, expected two of");  // one mode
  fails("--map xi:xi --at 0.53", "expected two different quantities");
  fails("--map xi:tau_s", "expected one point, --at 0.49");
  fails("--map phi:tau_s --map-y 0.1", "expected FROM:TO:STEP with two values or more");
  fails("--map phi:tau_s --map-y 0.1,0.1", "expected FROM:TO:STEP with two values or more");
  fails("--map phi:tau_s --map-y 0:0.1:0.01", "--map-y: tau_s is above zero");
  fails("--map phi:flame_slope --map-y 1:2:1", "--map-y: flame_slope is below zero");
  fails("--map phi:tau_s --map-y 0.001:0.1:0.0001", "--map-y: more than 400 points");
  fails("--at 0.53 --map-x 0.1:0.2:0.1", "--map-x: expected --map with it");
  fails("--at 0.53 --without gain", "--without: gain, expected one of gain_tolerance");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "prediction.json"));
}

// A loop gain of 0.8 at both points: (1b) rejects every model, unless it is left out.
TEST(WithoutCondition, IsNullInTheConfig) {
  const TemporaryFolder folder;
  const std::string experiments =
      "experiments:\n"
      "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,"
      " flame_slope: -0.48e-4}\n"
      "  - {name: b, phi: 0.51, frequency_hz: 205.7, phase_deg: -14.35, gain: 14.79,"
      " flame_slope: -0.42e-4}\n";
  const std::string plain = folder.Write("plain.yaml", experiments + "family: {members: 40}\n");
  const std::string open = folder.Write(
      "open.yaml", experiments + "family: {members: 40, test: {loop_gain_min: null}}\n");
  const std::string one = " --out " + (folder.path() / "one").string();
  const std::string two = " --out " + (folder.path() / "two").string();
  const ProgramResult empty = RunHowl("family " + plain + one);
  EXPECT_EQ(empty.status, 1);
  EXPECT_THAT(empty.out, HasSubstr("without touching the config: --without NAME"));
  ASSERT_EQ(RunHowl("family " + plain + one + " --without loop_gain_min").status, 0);
  ASSERT_EQ(RunHowl("family " + open + two).status, 0);
  for (const char* const name : {"family.csv", "tradeoff.csv"}) {
    EXPECT_EQ(ReadFile(folder.path() / "one" / name), ReadFile(folder.path() / "two" / name));
  }
  EXPECT_EQ(RunHowl("predict " + plain + one + " --at 0.53").status, 1);
  EXPECT_EQ(RunHowl("predict " + plain + one + " --at 0.53 --without loop_gain_min").status, 0);
  const ProgramResult measured =
      RunHowl("predict " + plain + one + " --at 0.56 --without loop_gain_min");
  EXPECT_THAT(measured.out, HasSubstr("most members are stable at rest at a reliable point"));
}

}  // namespace
}  // namespace howl::predict_map_test
