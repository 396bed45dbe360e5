// howl fit of a loop that records alone can show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::record_fit_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// A copy of first_rig.yaml beside its records, with this model; not `all`: without the last point.
class RecordFitOfFirstRig : public testing::Test {
 protected:
  ProgramResult Run(const std::string& command, const std::string& model, bool all = true) {
    std::filesystem::copy(std::string(HOWL_SOURCE_DIR) + "/configs/first_rig",
                          folder_.path() / "first_rig",
                          std::filesystem::copy_options::recursive |
                              std::filesystem::copy_options::overwrite_existing);
    std::string rig = ReadFile(Config("first_rig"));
    if (!all) rig.erase(rig.find("  - {name: rich"));
    config_ = folder_.Write("rig.yaml", rig + model).string();
    return RunHowl(command + " " + config_ + " --out " + (folder_.path() / "out").string());
  }
  Json Solution() const { return Json::parse(ReadFile(folder_.path() / "out/solution.json")); }

  TemporaryFolder folder_;
  std::string config_;
};

// Experiments 1 to 3 of R228, from whose fit the records were simulated (configs/first_rig.yaml).
std::string ThreeOfR228() {
  const std::string r228 = ReadFile(Config("r228"));
  return r228.substr(0, r228.find("  - {name: exp4"));
}

TEST_F(RecordFitOfFirstRig, FindsTheLoopThatMadeTheRecords) {
  const ProgramResult fit = Run("fit", "model: {modes: 1, residue: complex}\n");
  ASSERT_EQ(fit.status, 0) << fit.err << fit.out;
  const TemporaryFolder r228;
  const std::string table = r228.Write("three.yaml", ThreeOfR228()).string();
  ASSERT_EQ(RunHowl("fit " + table + " --quiet --out " + r228.path().string()).status, 0);
  const Json made_by = Json::parse(ReadFile(r228.path() / "solution.json"))["experiments"];
  const std::map<std::string, std::size_t> experiment_of = {
      {"rich", 0}, {"middle", 1}, {"lean", 2}};
  const Json solution = Solution();
  EXPECT_EQ(solution["schema"], "howl.solution/1");
  ASSERT_EQ(solution["experiments"].size(), 3u);
  for (const Json& found : solution["experiments"]) {
    const Json& truth = made_by[experiment_of.at(found["name"])];
    const auto near = [&](const Json& estimate, double value, const std::string& what) {
      const double distance = estimate["value"].get<double>() - value;
      EXPECT_LT(std::abs(distance), 4.0 * estimate["std"].get<double>())
          << what << " of " << found["name"] << ": " << estimate << " for " << value;
    };
    ASSERT_EQ(found["modes"].size(), 1u);
    const Json& mode = found["modes"][0];
    near(mode["omega_hz"], truth["omega_hz"], "omega");
    near(mode["xi"], truth["xi"], "xi");
    near(mode["N"], truth["N"], "N");
    near(mode["B"], 0.0, "B");
    near({{"value", found["tau_s"]}, {"std", found["tau_std_s"]}}, truth["tau_s"], "tau");
    near(found["small_signal"]["loop_gain"], truth["loop_gain"], "loop gain");
    EXPECT_EQ(found["omega_hz"], mode["omega_hz"]["value"]);
  }
  EXPECT_THAT(fit.out, HasSubstr("growth 1/s"));
  EXPECT_THAT(fit.out, HasSubstr("halves of the records, fitted by themselves"));
  // The model is the rig's: its halves agree, but for chance.
  for (const std::string quantity : {"tau_s", "small_signal.loop_gain", "modes.0.omega_hz"}) {
    const Json& scale = solution["interval_scales"][quantity];
    EXPECT_EQ(scale["experiments"], 3) << quantity;
    EXPECT_LT(scale["halves"].get<double>(), 3.0) << quantity;
    EXPECT_EQ(scale["factor"].get<double>(), std::max(1.0, scale["halves"].get<double>()));
    EXPECT_TRUE(experiment_of.contains(scale["farthest_apart"])) << quantity;
  }
  for (const Json& found : solution["experiments"]) {
    ASSERT_FALSE(found["other_delays"].empty());
    EXPECT_GT(found["other_delays"][0]["nats_below"], 10.0);
    ASSERT_EQ(found["halves"].size(), 2u);
    for (const Json& half : found["halves"]) {
      const double tau_s = found["tau_s"];
      EXPECT_NEAR(half["tau_s"]["value"].get<double>(), tau_s, 0.02 * tau_s);
      EXPECT_EQ(half["modes"].size(), found["modes"].size());
    }
  }
}

using LongRecordFitOfFirstRig = RecordFitOfFirstRig;

// Of p a fifteenth stands still: what the fit says of the loop stays within the intervals of the
// records as they were, and it says what was lost.
TEST_F(LongRecordFitOfFirstRig, StuckSamplesAreFilled) {
  const std::string model = "model: {modes: 1, residue: complex}\n";
  ASSERT_EQ(Run("fit", model).status, 0);
  const Json whole = Solution();
  std::string spoilt = ReadFile(config_);
  for (const std::string name : {"exp1.csv", "exp2.csv", "exp3.csv"}) {
    const std::filesystem::path samples = folder_.path() / "first_rig" / name;
    ASSERT_EQ(std::system(("gzip -dkf " + samples.string() + ".gz").c_str()), 0);
    std::istringstream lines(ReadFile(samples));
    std::string text;
    std::string held;
    int row = -1;  // the names
    for (std::string line; std::getline(lines, line); ++row) {
      const std::string p = line.substr(0, line.find(','));
      if (row < 150 || row % 300 >= 20) held = p;
      text += held + line.substr(p.size()) + "\n";
    }
    folder_.Write("first_rig/" + name, text);
    const std::size_t at = spoilt.find(name + ".gz");
    spoilt.erase(at + name.size(), 3);
  }
  const std::string config = folder_.Write("spoilt.yaml", spoilt).string();
  const ProgramResult fit =
      RunHowl("fit " + config + " --out " + (folder_.path() / "out").string());
  ASSERT_EQ(fit.status, 0) << fit.err << fit.out;
  EXPECT_THAT(fit.out,
              HasSubstr("lean: p stands still for 6.6 % of its samples, which are filled"));
  const Json solution = Solution();
  for (std::size_t e = 0; e < 3; ++e) {
    const Json& found = solution["experiments"][e];
    const Json& expected = whole["experiments"][e];
    EXPECT_NEAR(found["stuck_share"]["p"].get<double>(), 0.066, 0.001);
    EXPECT_EQ(found["stuck_share"]["q"], 0.0);
    EXPECT_EQ(expected["stuck_share"]["p"], 0.0);
    const auto near = [&](const Json& value, const Json& whole_value, double std) {
      EXPECT_NEAR(value.get<double>(), whole_value.get<double>(), 2.0 * std) << found["name"];
    };
    near(found["tau_s"], expected["tau_s"], expected["tau_std_s"]);
    for (const char* key : {"omega_hz", "xi", "N"}) {
      const Json& of_whole = expected["modes"][0][key];
      near(found["modes"][0][key]["value"], of_whole["value"], of_whole["std"]);
    }
  }
}

TEST_F(RecordFitOfFirstRig, SameAnswerWhateverTheThreads) {
  const std::string model =
      "model: {modes: 1, residue: complex, line_errors: false}\nsolver: {starts: 4}\n";
  ASSERT_EQ(Run("fit --threads 1", model, false).status, 0);
  const Json one = Solution();
  // Else the second would take the fits that the first has kept.
  std::filesystem::remove_all(folder_.path() / "out");
  ASSERT_EQ(Run("fit --threads 3", model, false).status, 0);
  EXPECT_EQ(Solution(), one);
}

TEST_F(RecordFitOfFirstRig, FamilyRefusesTheLoop) {
  const ProgramResult result = Run("family", "model: {modes: 3}\n");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("rig.yaml:8: model: states a loop that howl fit, simulate, "
                                    "predict and diagnose take"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out" / "run.json"));
}

// A value that is fixed, or a residual that is switched off, would be passed over in silence.
TEST_F(RecordFitOfFirstRig, SectionsThatItDoesNotTakeAreNamed) {
  const std::string model = "model: {residue: complex}\n";
  for (const std::string section :
       {"parameters: {tau_s: {initial: 0.003, fixed: true}}", "residuals: {transfer: off}"}) {
    const ProgramResult result = Run("fit", model + section + "\n");
    EXPECT_EQ(result.status, 2) << section;
    const std::string key = section.substr(0, section.find(':'));
    EXPECT_THAT(result.err, HasSubstr("rig.yaml:9: " + key +
                                      ": is not taken by a loop that is fitted to whole records"));
  }
}

TEST(RecordFit, NeedsRecordsOfBothSignals) {
  const TemporaryFolder folder;
  const std::string table =
      folder.Write("table.yaml", ReadFile(Config("r228")) + "model: {residue: complex}\n").string();
  const ProgramResult fit = RunHowl("fit " + table + " --out " + folder.path().string());
  EXPECT_EQ(fit.status, 2);
  EXPECT_THAT(fit.err, HasSubstr("exp1 has no record, expected one of p and q"));
  const std::string pressure_only =
      folder
          .Write("pressure.yaml", "experiments:\n  - {name: a, phi: 1, record: {file: " +
                                      std::string(HOWL_SOURCE_DIR) +
                                      "/configs/first_rig/exp1.csv.gz, pressure: p_pa, "
                                      "sampling_hz: 5000}}\nmodel: {damping: own}\n")
          .string();
  const ProgramResult other = RunHowl("fit " + pressure_only + " --out " + folder.path().string());
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("pressure.yaml:2: experiments: a has no heat release"));
}

TEST(RecordFit, NeedsFiftyPeriods) {
  const TemporaryFolder folder;
  std::string samples = "p,q\n";
  for (int i = 0; i < 400; ++i) {
    const double phase = 2.0 * std::numbers::pi * 200.0 * i / 5000.0;
    const double ripple = 0.01 * std::cos(3.7 * phase);
    samples += std::to_string(std::sin(phase) + ripple) + "," +
               std::to_string(std::sin(phase + 1.0) - ripple) + "\n";
  }
  folder.Write("short.csv", samples);
  const std::string config =
      folder
          .Write("short.yaml",
                 "experiments:\n  - {name: a, phi: 1, record: {file: short.csv, pressure: p, "
                 "heat_release: q, sampling_hz: 5000}}\nmodel: {residue: complex}\n")
          .string();
  const ProgramResult fit = RunHowl("fit " + config + " --out " + folder.path().string());
  EXPECT_EQ(fit.status, 2);
  EXPECT_THAT(fit.err, HasSubstr("short.yaml:2: experiments: a holds 16.0 periods at 200.0 Hz, "
                                 "expected at least 50 to fit a loop to"));
}

}  // namespace
}  // namespace howl::record_fit_test
