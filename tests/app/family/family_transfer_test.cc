// The broadband transfer, profiles and amplitudes through the program.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/app/program.h"

namespace howl::family_transfer_test {
namespace {

using Json = nlohmann::json;

Json FamilyJson(const TemporaryFolder& folder) {
  return Json::parse(ReadFile(folder.path() / "family.json"));
}

std::string PracticeConfig(const std::string& root, const std::string& test) {
  std::string text = "experiments:\n";
  for (const char* const line : {"1, phi: 0.56", "6, phi: 0.45"}) {
    const std::string number(1, line[0]);
    text += "  - {name: exp" + std::string(line) + ", record: {file: " + root +
            "/case002/data/exp" + number +
            ".csv, pressure: p, heat_release: q, sampling_hz: 5000}}\n";
  }
  return text +
         "model: {modes: 2}\n"
         "parameters: {M_over_N: {scope: shared, max: 1}, xi: {min: 0.02}}\n"
         "family: {members: 100, test: {" +
         test + "}}\n";
}

// A simulated rig without any effect: what it was made with lies within the bounds, which are a
// small part of those without the transfer.
TEST(FamilyTransfer, NarrowsTheFamilyAroundTheRig) {
  const char* const root = std::getenv("HOWL_PRACTICE");
  if (root == nullptr) GTEST_SKIP() << "HOWL_PRACTICE is not set";
  const Json truth = Json::parse(ReadFile(std::string(root) + "/case002.truth.json"));
  const TemporaryFolder folder;
  const auto config = folder.Write("with.yaml", PracticeConfig(root, "xi_max: 0.3")).string();
  const ProgramResult run = RunHowl("family " + config + " --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("broadband q-to-p transfer of 2 experiments"), std::string::npos);
  const Json with = FamilyJson(folder);
  EXPECT_EQ(with["test"]["transfer_distance_max"], 4.0);
  const Json& transfer = with["transfer"];
  EXPECT_EQ(transfer["experiments"], 2);
  EXPECT_TRUE(transfer["finite_without"]);
  EXPECT_LT(transfer["ln_volume_ratio"].get<double>(), -5.0);
  EXPECT_LT(transfer["least_distance"].get<double>(), 4.0);
  // Half of a 95 % interval, as its line says.
  std::smatch printed;
  ASSERT_TRUE(std::regex_search(run.out, printed, std::regex("exp\\(-[0-9.]+ ± ([0-9.]+)\\)")));
  EXPECT_NEAR(std::stod(printed[1]), 1.96 * transfer["ln_volume_ratio_std"].get<double>(), 0.051);
  EXPECT_NE(run.out.find("±: half of a 95 % interval"), std::string::npos);

  const auto off =
      folder.Write("without.yaml", PracticeConfig(root, "transfer_distance_max: null")).string();
  ASSERT_EQ(RunHowl("family " + off + " --quiet --out " + folder.path().string()).status, 0);
  const Json without = FamilyJson(folder);
  EXPECT_TRUE(without["test"]["transfer_distance_max"].is_null());
  EXPECT_FALSE(without.contains("transfer"));
  for (const auto& [name, row] : {std::pair{"exp1", 0}, std::pair{"exp6", 5}}) {
    for (const char* const parameter : {"omega_hz", "xi", "N", "M"}) {
      const Json& narrow = with["bounds"][name][parameter]["outer"];
      const Json& wide = without["bounds"][name][parameter]["outer"];
      const double value = truth["experiments"][row][parameter];
      EXPECT_LE(narrow[0].get<double>(), value) << name << parameter;
      EXPECT_GE(narrow[1].get<double>(), value) << name << parameter;
      const double wide_hi = wide[1].is_null() ? 1e9 : wide[1].get<double>();
      EXPECT_LT(narrow[1].get<double>() - narrow[0].get<double>(),
                0.5 * (wide_hi - wide[0].get<double>()))
          << name << parameter;
    }
  }
}

std::string MeasuredConfig(const std::string& distance) {
  return "operating_parameter: air_slpm\n"
         "experiments:\n"
         "  - {name: p19, air_slpm: 687, record: {file: \"${HOWL_DATA}/turbulent_combustor/"
         "p19.txt.gz\", time: 1, heat_release: 2, pressure: 3}}\n"
         "  - {name: p22, air_slpm: 800, record: {file: \"${HOWL_DATA}/turbulent_combustor/"
         "p22.txt.gz\", time: 1, heat_release: 2, pressure: 3}}\n"
         "model: {modes: 2}\n"
         "parameters: {M: {scope: experiment, max: 2000}, xi: {min: 0.02}}\n"
         "family: {members: 50, test: {gain_tolerance: 0.03, phase_tolerance_deg: 2,\n"
         "  loop_phase_tolerance_deg: 5, loop_gain_min: 0.7, second_crossing_tolerance_deg: null,\n"
         "  xi_max: 0.5, xi_increasing: false, transfer_distance_max: " +
         distance + "}}\n";
}

// On the measured rig two modes fit the transfer badly: the least distance says how badly, and just
// above it there is a family, just below none.
TEST(LongFamilyTransfer, MeasuredCombustorSaysHowFarTheModelIsFromTheTransfer) {
  if (std::getenv("HOWL_DATA") == nullptr) GTEST_SKIP() << "HOWL_DATA is not set";
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  const auto wide = folder.Write("wide.yaml", MeasuredConfig("20")).string();
  ASSERT_EQ(RunHowl("family " + wide + out).status, 0);
  const Json json = FamilyJson(folder);
  const double least = json["transfer"]["least_distance"];
  EXPECT_LT(json["transfer"]["ln_volume_ratio"].get<double>(), 0.0);
  ASSERT_GT(least, 0.1);
  const auto above =
      folder.Write("above.yaml", MeasuredConfig(std::to_string(1.05 * least))).string();
  EXPECT_EQ(RunHowl("family " + above + out).status, 0);
  const auto below =
      folder.Write("below.yaml", MeasuredConfig(std::to_string(0.8 * least))).string();
  const ProgramResult none = RunHowl("family " + below + out);
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.out.find("comes nearer to the records' q-to-p transfers"), std::string::npos);
  const Json empty = FamilyJson(folder);
  const auto& because = empty["empty_because"];
  EXPECT_NE(std::find(because.begin(), because.end(), "transfer_distance_max"), because.end());
}

// w (tau - tau_0) is a phase error less a loop phase error: the largest share of a tolerance is
// |w (tau - tau_0)| / 1.5 degrees, whatever the other experiments are.
TEST(FamilyProfile, DelayOfAPublishedExperiment) {
  const TemporaryFolder folder;
  const ProgramResult run =
      RunHowl("family " + Config("r228") + " --profile exp3.tau_s --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("profile of exp3.tau_s"), std::string::npos);
  std::stringstream lines(ReadFile(folder.path() / "profile.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("value,cost,flagged,exp1.omega_hz,exp1.xi,exp1.N,exp1.M,exp1.tau_s", 0), 0u);
  const double w = 2 * M_PI * 205.7, tau_0 = (270 - 14.35) * M_PI / 180 / w;
  int rows = 0;
  double last = 0.0;
  while (std::getline(lines, line)) {
    double value = 0.0, cost = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,", &value, &cost), 2);
    EXPECT_GT(value, last);
    last = value;
    EXPECT_NEAR(cost, std::abs(w * (value - tau_0)) / (1.5 * M_PI / 180), 2e-3) << value;
    ++rows;
  }
  EXPECT_GE(rows, 10);
  const Json profile = FamilyJson(folder)["profile"];
  EXPECT_EQ(profile["points"], rows);
  EXPECT_NEAR(profile["interval"][1].get<double>(), tau_0 + 1.5 * M_PI / 180 / w, 1e-8);
}

TEST(FamilyProfile, MistakesAreTheUsers) {
  const TemporaryFolder folder;
  for (const char* const text : {"xi", "exp9.xi", "'exp1.xi +'", "2"}) {
    const ProgramResult run = RunHowl("family " + Config("r228") + " --profile " + text +
                                      " --out " + folder.path().string());
    EXPECT_EQ(run.status, 2) << text;
    EXPECT_NE(run.err.find("--profile"), std::string::npos) << text;
  }
}

// An amplitude needs a flame that the config states; the answer does not depend on the threads.
TEST(FamilyPredictions, AmplitudeWhereAFlameIsStatedWhateverTheThreads) {
  const TemporaryFolder one, two;
  const std::string text = ReadFile(Config("r228"));
  const auto config =
      one.Write("flame.yaml", text + "\nsimulate: {flame_shape: tanh, saturation: 0.5}\n").string();
  ASSERT_EQ(
      RunHowl("family " + config + " --quiet --threads 1 --out " + one.path().string()).status, 0);
  ASSERT_EQ(
      RunHowl("family " + config + " --quiet --threads 2 --out " + two.path().string()).status, 0);
  EXPECT_EQ(ReadFile(one.path() / "family.json"), ReadFile(two.path() / "family.json"));
  int seen = 0;
  const Json json = FamilyJson(one);
  for (const Json& each : json["predictions"]) {
    if (each["name"] != "p_amplitude" || each["interval"].is_null()) continue;
    ++seen;
    // Saturated at 0.5, q has at most the amplitude 4 / pi * 0.5, and p that times the gain at f.
    EXPECT_GT(each["interval"][0].get<double>(), 0.0);
    EXPECT_LT(each["interval"][1].get<double>(), 4 / M_PI * 0.5 * 16.05 * 1.02);
  }
  EXPECT_EQ(seen, 4);  // exp5 and exp6 have a loop gain below one
}

}  // namespace
}  // namespace howl::family_transfer_test
