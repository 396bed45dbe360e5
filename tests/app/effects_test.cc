// Simulated rigs with effects, and the diagnosis of a table, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::effects_test {
namespace {

using testing::HasSubstr;
using testing::Not;

// The four stationary experiments with noise off, for a quarter of a second.
std::string Rig(const std::string& effects) {
  return ReadFile(Config("r228_reliable")) +
         "simulate:\n  duration_s: 0.25\n  settle_s: 0.2\n  combustion_noise_relative: 0\n"
         "  sensor_noise_relative: 0\n  effects: [" +
         effects + "]\n";
}

std::vector<double> Column(const std::string& csv, int column) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::vector<double> values;
  while (std::getline(lines, line)) {
    const std::size_t comma = line.find(',');
    values.push_back(std::stod(column == 0 ? line.substr(0, comma) : line.substr(comma + 1)));
  }
  return values;
}

TEST(SimulateEffects, ClippedRecordsThatDoNotTell) {
  const TemporaryFolder folder;
  const auto run = [&folder](const std::string& name, const std::string& effects) {
    const auto config = folder.Write(name + ".yaml", Rig(effects));
    return RunHowl("simulate " + config.string() + " --out " + (folder.path() / name).string());
  };
  ASSERT_EQ(run("base", "").status, 0);
  ASSERT_EQ(run("null", "{effect: q_clipping, fraction: .inf}").status, 0);
  const ProgramResult clipped = run("clipped", "{effect: q_clipping, fraction: 0.5}");
  ASSERT_EQ(clipped.status, 0) << clipped.err;
  const auto read = [&folder](const char* name, const char* file) {
    return ReadFile(folder.path() / name / file);
  };
  EXPECT_EQ(read("null", "exp1.csv"), read("base", "exp1.csv"));
  const std::vector<double> whole = Column(read("base", "exp1.csv"), 1);
  const std::vector<double> cut = Column(read("clipped", "exp1.csv"), 1);
  ASSERT_EQ(whole.size(), 1250u);
  ASSERT_EQ(cut.size(), whole.size());
  const double limit = *std::ranges::max_element(cut);
  // Noise-free q is a cycle with small harmonics: half its amplitude, but for these.
  EXPECT_NEAR(limit / *std::ranges::max_element(whole), 0.5, 0.05);
  for (std::size_t i = 0; i < cut.size(); ++i) {
    EXPECT_EQ(cut[i], std::min(std::max(whole[i], -limit), limit));
  }
  EXPECT_EQ(read("clipped", "records.yaml"), read("base", "records.yaml"));
  EXPECT_THAT(read("clipped", "records.yaml"), Not(HasSubstr("clipping")));
}

TEST(SimulateEffects, AMistakeIsOneLine) {
  const TemporaryFolder folder;
  const auto config = folder.Write("a.yaml", Rig("{effect: delay_dispersion, sigma_s: 0.001}"));
  const ProgramResult run =
      RunHowl("simulate " + config.string() + " --out " + (folder.path() / "out").string());
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1);
  EXPECT_THAT(run.err, HasSubstr("simulate.effects[0]: "));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(DiagnoseTable, PapersTableInTheContractsSchema) {
  const TemporaryFolder folder;
  const ProgramResult run =
      RunHowl("diagnose " + Config("r228_two_modes") + " --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("verdict: unknown"));
  const auto json = nlohmann::json::parse(ReadFile(folder.path() / "diagnosis.json"));
  EXPECT_EQ(json.at("schema"), "howl.diagnosis/1");
  EXPECT_EQ(json.at("verdict").at("kind"), "unknown");
  EXPECT_TRUE(json.at("verdict").at("effect").is_null());
  EXPECT_THAT(json.at("verdict").at("indistinguishable").dump(), HasSubstr("q_sensor_lowpass"));
  const auto lag = json.at("candidates").at(0).at("parameters").at("lag_deg");
  EXPECT_LT(lag.at("lo"), lag.at("hi"));
  // Passivity of G allows experiment 1 no more, with the line below 770 Hz; 45 degrees is far out.
  EXPECT_LT(lag.at("hi"), 7.1);
}

TEST(DiagnoseTable, ATableWithoutLinesSaysNothing) {
  const TemporaryFolder folder;
  const ProgramResult run =
      RunHowl("diagnose " + Config("r228") + " --out " + (folder.path() / "out").string());
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1);
  EXPECT_THAT(run.err, HasSubstr("expected"));
}

}  // namespace
}  // namespace howl::effects_test
