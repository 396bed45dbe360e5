// howl predict as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/program.h"

namespace howl::predict_test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

ProgramResult Predict(const std::string& config, const TemporaryFolder& folder,
                      const std::string& more) {
  return RunHowl("predict " + config + " --out " + (folder.path() / "out").string() + " " + more);
}

Json Predicted(const TemporaryFolder& folder) {
  return Json::parse(ReadFile(folder.path() / "out" / "prediction.json"));
}

TEST(Predict, PublishedTableBetweenAndBeyond) {
  const TemporaryFolder folder;
  const ProgramResult run = Predict(Config("r228"), folder, "--at 0.52 --at 0.56,0.60 --at=0.9");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("no guarantee"));
  EXPECT_THAT(run.out, HasSubstr("the flame's shape is assumed"));
  EXPECT_THAT(run.out, HasSubstr("outside of what the data can say"));
  EXPECT_THAT(run.out, HasSubstr("guaranteed: every member of the family closes its loop at exp1"));
  const Json json = Predicted(folder);
  EXPECT_EQ(json["schema"], "howl.prediction/1");
  EXPECT_EQ(json["members"], 1000);
  ASSERT_EQ(json["points"].size(), 4u);
  const Json& between = json["points"][0];
  EXPECT_EQ(between["status"], "between");
  EXPECT_TRUE(between["guaranteed"].is_null());
  // Between experiments 3 (205.7 Hz) and 2 (209.1 Hz).
  EXPECT_NEAR(between["frequency_hz"]["value"].get<double>(), 207.4, 0.3);
  EXPECT_LT(between["frequency_hz"]["lo"], 205.7);
  EXPECT_GT(between["frequency_hz"]["hi"], 209.1);
  EXPECT_EQ(between["share_unstable"], 1.0);
  const Json& measured = json["points"][1];
  EXPECT_EQ(measured["experiment"], "exp1");
  EXPECT_LT(measured["guaranteed"]["frequency_hz"][0], measured["frequency_hz"]["lo"]);
  EXPECT_GT(measured["guaranteed"]["frequency_hz"][1], measured["frequency_hz"]["hi"]);
  EXPECT_LT(measured["guaranteed"]["frequency_hz"][0], 219.9);
  EXPECT_GT(measured["guaranteed"]["frequency_hz"][1], 219.9);
  EXPECT_EQ(json["points"][2]["status"], "beyond");
  EXPECT_EQ(json["points"][3]["status"], "outside");
  EXPECT_TRUE(json["points"][3]["frequency_hz"]["value"].is_null());
}

TEST(Predict, CsvHasARowForEachPointAndQuantity) {
  const TemporaryFolder folder;
  ASSERT_EQ(Predict(Config("r228_reliable"), folder, "--at 0.50:0.52:0.01 --quiet").status, 0);
  std::istringstream csv(ReadFile(folder.path() / "out" / "prediction.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "phi,quantity,value,lo,hi,guaranteed_lo,guaranteed_hi");
  int rows = 0;
  int frequencies = 0;
  while (std::getline(csv, line)) {
    ++rows;
    if (line.find("frequency_hz") != std::string::npos) ++frequencies;
  }
  EXPECT_EQ(rows, 15);
  EXPECT_EQ(frequencies, 3);
}

TEST(Predict, SameSeedSameAnswerOnAnyNumberOfThreads) {
  const TemporaryFolder one, two, other;
  const std::string at = "--at 0.48:0.60:0.01 --quiet ";
  ASSERT_EQ(Predict(Config("r228"), one, at + "--threads 1").status, 0);
  ASSERT_EQ(Predict(Config("r228"), two, at + "--threads 2").status, 0);
  ASSERT_EQ(Predict(Config("r228"), other, at + "--seed 2").status, 0);
  for (const char* const name : {"prediction.csv", "prediction.json"}) {
    EXPECT_EQ(ReadFile(one.path() / "out" / name), ReadFile(two.path() / "out" / name));
    EXPECT_NE(ReadFile(one.path() / "out" / name), ReadFile(other.path() / "out" / name));
  }
}

TEST(Predict, MistakesAreTheUsers) {
  const TemporaryFolder folder;
  const auto fails = [&](const std::string& more, const std::string& what) {
    const ProgramResult run = Predict(Config("r228"), folder, more);
    EXPECT_EQ(run.status, 2) << more;
    EXPECT_THAT(run.err, HasSubstr(what)) << more;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  fails("", "expected --at 0.6");
  fails("--at rich", "--at: rich, expected a number");
  fails("--at nan", "--at: nan, expected a number");
  fails("--at 0.5,", "expected a number");
  fails("--at 0.5:0.7", "expected a number or FROM:TO:STEP");
  fails("--at 0.5:0.7:0", "expected a step above zero");
  fails("--at 0.5:0.7:-0.01", "expected a step above zero");
  fails("--at 0.7:0.5:0.01", "expected FROM below TO");
  fails("--at 0.5:0.7:0.00001", "more than 10000 points");
  fails("--at 0.5:0.6:0.00002 --at 0.5:0.6:0.00002", "more than 10000 points");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "prediction.json"));
}

constexpr const char* kOne =
    "operating_parameter: air_slpm\n"
    "experiments:\n"
    "  - {name: only, air_slpm: 80, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,"
    " flame_slope: -0.703e-4}\n"
    "family: {members: 60, width: 0.3}\n";

TEST(Predict, OneExperimentPredictsItselfAlone) {
  const TemporaryFolder folder;
  const std::string config = folder.Write("one.yaml", kOne).string();
  const ProgramResult other = Predict(config, folder, "--at 85");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("one.yaml:3: experiments: one operating point"));
  EXPECT_THAT(other.err, HasSubstr("what is possible is --at 80"));
  ASSERT_EQ(Predict(config, folder, "--at 80").status, 0);
  EXPECT_EQ(Predicted(folder)["points"][0]["status"], "measured");
  EXPECT_THAT(ReadFile(folder.path() / "out" / "prediction.csv"), HasSubstr(",air_slpm\n"));
}

TEST(Predict, TwoExperimentsSayThatTheyKnowNoScatter) {
  const TemporaryFolder folder;
  const std::string config =
      folder
          .Write("two.yaml",
                 "experiments:\n"
                 "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
                 "  - {name: b, phi: 0.51, frequency_hz: 205.7, phase_deg: -14.35, gain: 14.79}\n"
                 "family: {members: 60, width: 0.3}\n")
          .string();
  const ProgramResult run = Predict(config, folder, "--at 0.53");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("two operating points do not show"));
  const Json json = Predicted(folder);
  EXPECT_EQ(json["scatter_known"], false);
  EXPECT_TRUE(json["points"][0]["growth_rate_1_s"]["value"].is_null());  // no flame slope
  EXPECT_GT(json["points"][0]["frequency_hz"]["lo"], 205.0);
}

TEST(Predict, NegativeAnswers) {
  const TemporaryFolder folder;
  std::string text = ReadFile(Config("r228"));
  const std::string from = "omega_spread_max: 0.25";
  text.replace(text.find(from), from.size(), "omega_spread_max: 0.15");
  const std::string empty = folder.Write("empty.yaml", text).string();
  EXPECT_EQ(Predict(empty, folder, "--at 0.52 --quiet").status, 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "prediction.json"));
  const ProgramResult outside = Predict(Config("r228"), folder, "--at 0.9");
  EXPECT_EQ(outside.status, 1);
  EXPECT_THAT(outside.out, HasSubstr("outside of what the data can say"));
}

// The records of a simulated rig: the flame is measured, and amplitudes are those of p.
TEST(Predict, RecordsGiveTheAmplitudeOfThePressure) {
  const TemporaryFolder folder;
  ASSERT_EQ(Predict(Config("first_rig"), folder, "--at 0.51,0.52,0.53,0.56").status, 0);
  const Json json = Predicted(folder);
  EXPECT_EQ(json["flame"], "measured");
  // sqrt(2) times the rms of p in each record, computed from its file.
  const double measured[] = {256.06, 208.81, 179.53};
  const std::size_t at[] = {0, 2, 3};
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& amplitude = json["points"][at[k]]["p_amplitude"];
    EXPECT_NEAR(amplitude["value"].get<double>() / measured[k], 1.0, 0.02);
    EXPECT_LT(amplitude["lo"], measured[k]);
    EXPECT_GT(amplitude["hi"], measured[k]);
  }
}

}  // namespace
}  // namespace howl::predict_test
