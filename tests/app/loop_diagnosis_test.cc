// howl diagnose of a loop that records alone can show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.h"

namespace howl::loop_diagnosis_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// A copy of first_rig.yaml beside its records, with this model, without its last point.
class LoopDiagnosis : public testing::Test {
 protected:
  ProgramResult Diagnose(const std::string& model, const std::string& options) {
    std::filesystem::copy(std::string(HOWL_SOURCE_DIR) + "/configs/first_rig",
                          folder_.path() / "first_rig",
                          std::filesystem::copy_options::recursive |
                              std::filesystem::copy_options::overwrite_existing);
    std::string rig = ReadFile(Config("first_rig"));
    rig.erase(rig.find("  - {name: rich"));
    const std::string config = folder_.Write("rig.yaml", rig + "model: " + model + "\n").string();
    return RunHowl("diagnose " + config + " " + options + " --out " +
                   (folder_.path() / "out").string());
  }
  bool IsWritten() const { return std::filesystem::exists(folder_.path() / "out/diagnosis.json"); }

  TemporaryFolder folder_;
};

// The records are of a loop of one mode whose flame answers to dp/dt.
TEST_F(LoopDiagnosis, SaysWhatTheConfigsLoopLacks) {
  const ProgramResult run = Diagnose(
      "{modes: 1, flame_input: velocity}",
      "--without p_sensor_noise,q_sensor_noise,duct_noise,background_noise,extra_acoustic_mode,"
      "complex_residues,delay_dispersion,gamma_delays");
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  EXPECT_THAT(run.out, HasSubstr("to go on from there: --with flame_input_pressure_rate\n"));
  EXPECT_THAT(run.out, HasSubstr("alone, at each point by itself, nats: "));
  const Json json = Json::parse(ReadFile(folder_.path() / "out/diagnosis.json"));
  EXPECT_EQ(json["schema"], "howl.diagnosis/1");
  double sum = 0.0;
  for (const auto& [answer, probability] : json["verdict"]["probability"].items()) {
    sum += probability.get<double>();
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
  // Trials leave a doubt.
  EXPECT_LT(json["verdict"]["probability"]["flame_input_pressure_rate"].get<double>(), 0.95);
  ASSERT_EQ(json["budget"].size(), 1u);
  EXPECT_EQ(json["budget"][0]["item"], "flame_input_pressure_rate");
  EXPECT_GT(json["budget"][0]["lost_without"]["nats"].get<double>(), 20.0);
  EXPECT_EQ(json["items"], Json{"flame_input_pressure_rate"});
  EXPECT_EQ(json["base"]["flame_input"], "velocity");
  EXPECT_EQ(json["best"]["flame_input"], "pressure_rate");
  // About one mode's cycle both inputs are one but for the delay: harmonics alone tell them apart.
  EXPECT_LE(json["gap"]["after"].get<double>(), json["gap"]["before"].get<double>());
  EXPECT_TRUE(json["line_errors"]["q_from_p"]["nats"].is_number());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/diagnosis.state"));
}

// What was found as a config, which fit takes as it stands.
TEST_F(LoopDiagnosis, WritesAConfigOfWhatItFound) {
  const std::filesystem::path next = folder_.path() / "out/rig_next.yaml";
  ProgramResult run = Diagnose("{modes: 1, flame_input: velocity}",
                               "--with flame_input_pressure_rate,channel_skew --most-items 0");
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  EXPECT_THAT(run.out, HasSubstr("written: diagnosis.json and rig_next.yaml (a config of what was "
                                 "found) in " +
                                 next.parent_path().string() + "\n"));
  const std::string text = ReadFile(next);
  EXPECT_THAT(text, HasSubstr("flame_input: pressure_rate"));
  EXPECT_THAT(text, HasSubstr("delay_s: "));
  EXPECT_THAT(text, HasSubstr("The verdict is unknown"));
  const Json stated = Json::parse(ReadFile(folder_.path() / "out/diagnosis.json"))["stated"];
  // The rig has no skew; two records tell it to some microseconds.
  EXPECT_LT(std::abs(stated["delay_s"].get<double>()), 2e-5);
  run = RunHowl("check " + next.string());
  EXPECT_EQ(run.status, 0) << run.err << run.out;
  // Where nothing is found an earlier one does not stay.
  run = Diagnose("{modes: 1, flame_input: velocity}", "--most-items 0");
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  EXPECT_FALSE(std::filesystem::exists(next));
}

// The gap of an account, and nothing said of what it lacks.
TEST_F(LoopDiagnosis, ScoresAnAccountWithoutASearch) {
  const ProgramResult run = Diagnose("{modes: 1, flame_input: velocity}",
                                     "--with flame_input_pressure_rate --most-items 0");
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  const Json json = Json::parse(ReadFile(folder_.path() / "out/diagnosis.json"));
  EXPECT_EQ(json["verdict"]["kind"], "unknown");
  EXPECT_EQ(json["unknown_because"], "nothing that the loop may lack was looked for");
  EXPECT_TRUE(json["budget"].empty());
  EXPECT_EQ(json["base"]["flame_input"], "pressure_rate");
  EXPECT_LE(json["gap"]["after"].get<double>(), json["gap"]["without_given"].get<double>());
}

TEST_F(LoopDiagnosis, RefusesWhatItDoesNotTake) {
  const std::string loop = "{modes: 1, residue: complex}";
  const auto refuses = [&](const std::string& model, const std::string& options,
                           const std::string& what) {
    const ProgramResult run = Diagnose(model, options);
    EXPECT_EQ(run.status, 2) << options;
    EXPECT_THAT(run.err, HasSubstr(what));
    EXPECT_FALSE(IsWritten());
  };
  refuses(loop, "--plan", "--plan: the config's model states a loop");
  refuses(loop, "--bootstrap 19", "--bootstrap: the config's model states a loop");
  refuses(loop, "--one-cause", "--one-cause: the config's model states a loop");
  refuses(loop, "--most-items -1", "--most-items");
  refuses(loop, "--without duct_nois", "did you mean duct_noise?");
  refuses(loop, "--with duct_nois", "did you mean duct_noise?");
  refuses("{modes: 1}", "--one-cause --with duct_noise", "--with begins a budget of records");
  refuses(loop +
              "\neffects: [{name: mine, at: acoustics, transfer: 1 + a, parameters: {a: "
              "{null_value: 0, low: 0, high: 1, starts: [0.1]}}}]",
          "", "mine is not one transfer function at all operating points");
  refuses("{modes: auto}", "", "is auto, expected a number");
  refuses("{modes: 1, flame_input: auto}", "", "is auto, expected one of them");
}

}  // namespace
}  // namespace howl::loop_diagnosis_test
