// What comes after the fit of a loop that records alone can show: simulate, predict, and going on
// with a fit that was interrupted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::record_loop_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr const char* kModel =
    "model: {modes: 1, residue: complex, line_errors: false}\nsolver: {starts: 4}\n";

// Two points of first_rig.yaml, fitted once.
class RecordLoop : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    std::filesystem::copy(std::string(HOWL_SOURCE_DIR) + "/configs/first_rig",
                          folder_->path() / "first_rig", std::filesystem::copy_options::recursive);
    const ProgramResult fit = RunHowl("fit " + WriteConfig("rig", "") + Out("out"));
    ASSERT_EQ(fit.status, 0) << fit.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string WriteConfig(const std::string& name, const std::string& further) {
    std::string rig = ReadFile(Config("first_rig"));
    rig.erase(rig.find("  - {name: rich"));
    return folder_->Write(name + ".yaml", rig + kModel + further).string();
  }
  static std::string Rig() { return (folder_->path() / "rig.yaml").string(); }
  static std::string Out(const std::string& name) {
    return " --out " + (folder_->path() / name).string();
  }
  static std::string Read(const std::string& name) { return ReadFile(folder_->path() / name); }
  static Json Solution() { return Json::parse(Read("out/solution.json")); }

  static TemporaryFolder* folder_;
};
TemporaryFolder* RecordLoop::folder_ = nullptr;

// The cells of a table by its header, one row each.
std::vector<std::map<std::string, std::string>> Rows(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::map<std::string, std::string> row;
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (rows.empty() && names.size() <= column) {
        names.push_back(cell);
      }
      row[names[column]] = cell;
    }
    rows.push_back(row);
  }
  rows.erase(rows.begin());
  return rows;
}

// Another part of the program, the analysis of cycles, finds the cycle of the records that were
// fitted in those that were simulated.
TEST_F(RecordLoop, SimulatesTheCycleThatWasRecorded) {
  const ProgramResult simulated = RunHowl("simulate " + Rig() + Out("out"));
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  EXPECT_THAT(simulated.out, HasSubstr("on the cycle at 205.8 Hz"));
  EXPECT_THAT(Read("out/records.yaml"), HasSubstr("residue"));
  EXPECT_THAT(Read("out/records.yaml"), Not(HasSubstr("parameters")));
  const Json loops = Json::parse(Read("out/simulation.json"))["experiments"];
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0]["modes"][0]["N"].get<double>(),
            Solution()["experiments"][0]["modes"][0]["N"]["value"].get<double>());
  ASSERT_EQ(RunHowl("analyse " + Rig() + Out("of_recorded")).status, 0);
  ASSERT_EQ(
      RunHowl("analyse " + (folder_->path() / "out/records.yaml").string() + Out("of_simulated"))
          .status,
      0);
  const auto recorded = Rows(Read("of_recorded/characteristics.csv"));
  const auto found = Rows(Read("of_simulated/characteristics.csv"));
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t e = 0; e < 2; ++e) {
    const auto near = [&](const std::string& name, double within) {
      EXPECT_NEAR(std::stod(found[e].at(name)), std::stod(recorded[e].at(name)), within) << name;
    };
    near("frequency_hz", 0.3);
    near("gain", 0.01 * std::stod(recorded[e].at("gain")));
    near("phase_deg", 1.0);
  }
  // The same seed, the same bytes, whatever the threads.
  const std::string before = Read("out/lean.csv");
  ASSERT_EQ(RunHowl("simulate --threads 1 " + Rig() + Out("out")).status, 0);
  EXPECT_EQ(Read("out/lean.csv"), before);
}

TEST_F(RecordLoop, WhatTheRecordsShowIsNotStated) {
  const std::string config = WriteConfig("stated", "simulate: {flame_shape: tanh}\n");
  const ProgramResult simulated = RunHowl("simulate " + config + Out("stated"));
  EXPECT_EQ(simulated.status, 2);
  EXPECT_THAT(
      simulated.err,
      HasSubstr("stated.yaml:9: simulate.flame_shape: is not taken by a loop that is fitted "
                "to whole records"));
  const ProgramResult member = RunHowl("simulate --member 1 " + Rig() + Out("stated"));
  EXPECT_EQ(member.status, 2);
  EXPECT_THAT(member.err, HasSubstr("--member"));
  const ProgramResult map = RunHowl("predict --map phi:tau_s " + Rig() + Out("stated"));
  EXPECT_EQ(map.status, 2);
  EXPECT_THAT(map.err, HasSubstr("--map"));
}

TEST_F(RecordLoop, PredictsLoopsBetweenThePoints) {
  const ProgramResult predicted = RunHowl("predict --at 0.51,0.52,0.7 " + Rig() + Out("out"));
  ASSERT_EQ(predicted.status, 0) << predicted.err;
  const auto rows = Rows(Read("out/prediction.csv"));
  ASSERT_EQ(rows.size(), 15u);
  const auto cell = [&](const std::string& phi, const std::string& quantity,
                        const std::string& column) {
    for (auto row : rows) {
      if (row["phi"] == phi && row["quantity"] == quantity) return row[column];
    }
    return std::string("none");
  };
  const Json small = Solution()["experiments"][0]["small_signal"];
  EXPECT_DOUBLE_EQ(std::stod(cell("0.51", "loop_gain", "value")),
                   small["loop_gain"]["value"].get<double>());
  // Between the frequencies of its neighbours, and known less than they.
  EXPECT_GT(std::stod(cell("0.52", "frequency_hz", "value")), 205.0);
  EXPECT_LT(std::stod(cell("0.52", "frequency_hz", "value")), 210.0);
  EXPECT_LT(std::stod(cell("0.52", "frequency_hz", "lo")), 205.0);
  EXPECT_GT(std::stod(cell("0.51", "share_unstable", "value")), 0.99);
  EXPECT_EQ(cell("0.7", "frequency_hz", "value"), "");
  for (auto row : rows) EXPECT_EQ(row["guaranteed_lo"], "");
  const Json json = Json::parse(Read("out/prediction.json"));
  EXPECT_EQ(json["points"][0]["experiment"], "lean");
  EXPECT_EQ(json["points"][2]["status"], "outside");
  ASSERT_EQ(RunHowl("report " + Rig() + Out("out")).status, 0);
  const std::string page = Read("out/report.html");
  EXPECT_THAT(page, HasSubstr("unstable at rest with a probability of"));
  EXPECT_THAT(page, Not(HasSubstr("of the members")));
  EXPECT_EQ(RunHowl("predict --at 0.7 " + Rig() + Out("out")).status, 1);
}

// What `fit` leaves behind when this signal ends it, as soon as it has kept some of its units.
int StatusAfter(int signal, const std::string& arguments, const std::filesystem::path& state) {
  const pid_t child = StartHowl(arguments);
  std::error_code ignored;
  EXPECT_TRUE(WaitUntil([&] { return std::filesystem::file_size(state, ignored) + 1 >= 30000; }));
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(RecordLoop, AnInterruptedFitGoesOnToTheSameBytes) {
  for (const auto& [signal, name] :
       {std::pair(SIGINT, std::string("interrupted")), {SIGKILL, "killed"}}) {
    const std::filesystem::path out = folder_->path() / name;
    const std::string arguments = "fit --quiet " + Rig() + Out(name) + " 2>/dev/null";
    EXPECT_EQ(StatusAfter(signal, arguments, out / "fit.state"), signal == SIGINT ? 130 : -1);
    EXPECT_FALSE(std::filesystem::exists(out / "solution.json"));
    const ProgramResult on = RunHowl("fit " + Rig() + Out(name));
    ASSERT_EQ(on.status, 0) << on.err;
    EXPECT_THAT(on.err, HasSubstr("going on from"));
    EXPECT_EQ(ReadFile(out / "solution.json"), Read("out/solution.json")) << name;
  }
}

TEST_F(RecordLoop, AUnitThatWasDamagedIsDoneAnew) {
  std::filesystem::create_directories(folder_->path() / "damaged");
  std::string state = Read("out/fit.state");
  const std::size_t end = state.find("\ncomplete ");
  ASSERT_NE(end, std::string::npos);
  state.erase(end + 1);
  state[state.size() / 2] = static_cast<char>(~state[state.size() / 2]);
  folder_->Write("damaged/fit.state", state);
  const ProgramResult on = RunHowl("fit " + Rig() + Out("damaged"));
  ASSERT_EQ(on.status, 0) << on.err;
  EXPECT_THAT(on.err, HasSubstr("what was damaged there is done anew"));
  EXPECT_EQ(Read("damaged/solution.json"), Read("out/solution.json"));
}

// The loop that was fitted is that of records which were simulated from it, whose fit finds it.
TEST(LongRecordLoop, AFitFindsTheLoopThatWasSimulated) {
  const TemporaryFolder folder;
  std::filesystem::copy(std::string(HOWL_SOURCE_DIR) + "/configs/first_rig",
                        folder.path() / "first_rig", std::filesystem::copy_options::recursive);
  const std::string config =
      folder.Write("rig.yaml", ReadFile(Config("first_rig")) + kModel).string();
  const std::string out = (folder.path() / "out").string();
  const std::string again = (folder.path() / "again").string();
  ASSERT_EQ(RunHowl("fit " + config + " --out " + out).status, 0);
  ASSERT_EQ(RunHowl("simulate " + config + " --out " + out).status, 0);
  ASSERT_EQ(RunHowl("fit " + out + "/records.yaml --out " + again).status, 0);
  const Json truth = Json::parse(ReadFile(out + "/solution.json"))["experiments"];
  const Json found = Json::parse(ReadFile(again + "/solution.json"))["experiments"];
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t e = 0; e < 3; ++e) {
    for (const char* const name : {"omega_hz", "xi", "N", "B"}) {
      const Json& estimate = found[e]["modes"][0][name];
      const double value = truth[e]["modes"][0][name]["value"].get<double>();
      EXPECT_LT(std::abs(estimate["value"].get<double>() - value),
                4.0 * estimate["std"].get<double>())
          << name << " of " << found[e]["name"];
    }
    EXPECT_LT(std::abs(found[e]["tau_s"].get<double>() - truth[e]["tau_s"].get<double>()),
              4.0 * found[e]["tau_std_s"].get<double>());
  }
}

}  // namespace
}  // namespace howl::record_loop_test
