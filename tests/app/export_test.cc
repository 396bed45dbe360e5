// howl export as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/program.h"

namespace howl::export_test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

ProgramResult Export(const std::string& config, const TemporaryFolder& folder,
                     const std::string& more = "") {
  return RunHowl("export " + config + " --out " + (folder.path() / "out").string() + " " + more);
}

Json Read(const TemporaryFolder& folder, const char* name) {
  return Json::parse(ReadFile(folder.path() / "out" / name));
}

// Gain and delay of Flame.txt.
std::pair<double, double> LiteFlame(const std::filesystem::path& path) {
  std::istringstream words(ReadFile(path));
  std::string title;
  for (int k = 0; k < 3; ++k) words >> title;
  double type = 0.0, gain = 0.0, delay_ms = 0.0;
  words >> type >> gain >> delay_ms;
  return {gain, delay_ms};
}

TEST(Export, ThePublishedFlamesOfTheJointFit) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunHowl("fit " + Config("r228_reliable") + " --quiet --out " +
                    (folder.path() / "out").string())
                .status,
            0);
  const ProgramResult run =
      Export(Config("r228_reliable"), folder, "--mean-heat-release 60 --full-modulation 2e6");
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Read(folder, "export.json");
  const Json solution = Read(folder, "solution.json");
  EXPECT_EQ(json["schema"], "howl.export/1");
  const double slopes[] = {-0.703e-4, -0.707e-4, -0.670e-4, -0.626e-4};  // the paper, table 3
  ASSERT_EQ(json["experiments"].size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Json& one = json["experiments"][i];
    const auto at = folder.path() / "out" / "export" / one["name"].get<std::string>();
    const auto [gain, delay_ms] = LiteFlame(at / "Flame.txt");
    EXPECT_NEAR(gain, -slopes[i] * 2e6 / 60.0, 1e-12);
    EXPECT_DOUBLE_EQ(delay_ms, 1e3 * solution["experiments"][i]["tau_s"].get<double>());
    // An assumed shape has no saturation in the units of q: the flame at rest alone.
    EXPECT_EQ(one["flame"], "assumed");
    EXPECT_EQ(one["velocity_ratios"], Json({0.0}));
    for (const Json& file : one["files"]) {
      EXPECT_TRUE(std::filesystem::exists(at / file.get<std::string>())) << file;
    }
    EXPECT_FALSE(std::filesystem::exists(at / "FTF_0.1.mat"));
  }
}

TEST(Export, AMemberAndARecordsOwnFlame) {
  const TemporaryFolder folder;
  const std::string config = Config("first_rig");
  ASSERT_EQ(
      RunHowl("family " + config + " --quiet --out " + (folder.path() / "out").string()).status, 0);
  ASSERT_EQ(Export(config, folder, "--member 3 --ratios 0:2:0.5 --quiet").status, 0);
  const Json json = Read(folder, "export.json");
  EXPECT_EQ(json["member"], 3);
  std::istringstream family(ReadFile(folder.path() / "out" / "family.csv"));
  std::string line;
  std::string row;
  while (std::getline(family, line)) {
    if (line.starts_with("3,lean,")) row = line;
  }
  std::istringstream cells(row);  // member,experiment,phi,omega_hz,xi,N,M,tau_s
  std::string tau;
  for (int k = 0; k < 8; ++k) std::getline(cells, tau, ',');
  const auto at = folder.path() / "out" / "export" / "lean";
  const auto [gain, delay_ms] = LiteFlame(at / "Flame.txt");
  EXPECT_DOUBLE_EQ(delay_ms, 1e3 * std::stod(tau));
  EXPECT_NEAR(gain, 1.0, 1e-12);  // relative to the flame itself
  EXPECT_EQ(json["experiments"][0]["flame"], "measured");
  EXPECT_TRUE(std::filesystem::exists(at / "FTF_1.5.mat"));
  // Another export leaves no table of ratios that it has not.
  ASSERT_EQ(Export(config, folder, "--ratios 0,1 --quiet").status, 0);
  EXPECT_FALSE(std::filesystem::exists(at / "FTF_1.5.mat"));
  EXPECT_TRUE(std::filesystem::exists(at / "FTF_1.mat"));
}

TEST(Export, MistakesAreTheUsers) {
  const TemporaryFolder folder;
  const auto fails = [&](const std::string& more, const std::string& what) {
    const ProgramResult run = Export(Config("r228"), folder, more);
    EXPECT_EQ(run.status, 2) << more;
    EXPECT_THAT(run.err, HasSubstr(what)) << more;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  fails("--mean-heat-release 3", "expected --mean-heat-release and --full-modulation together");
  fails("--mean-heat-release 0 --full-modulation 1",
        "--mean-heat-release: expected a number above");
  fails("--ratios 0:1", "--ratios: 0:1, expected a number or FROM:TO:STEP");
  fails("--frequencies -5:10:5", "--frequencies: a value below zero");
  fails("--member 2", "family.csv");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "export"));
}

TEST(Export, WithoutAnyFlameSlopeTheAnswerIsNegative) {
  const TemporaryFolder folder;
  const std::string config = folder.Write(
      "two.yaml",
      "experiments:\n"
      "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
      "  - {name: b, phi: 0.51, frequency_hz: 205.7, phase_deg: -14.35, gain: 14.79}\n");
  EXPECT_EQ(Export(config, folder).status, 1);
  const auto at = folder.path() / "out" / "export" / "a";
  EXPECT_TRUE(std::filesystem::exists(at / "acoustics.csv"));
  EXPECT_FALSE(std::filesystem::exists(at / "Flame.txt"));
}

}  // namespace
}  // namespace howl::export_test
