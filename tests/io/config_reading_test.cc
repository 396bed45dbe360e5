// A config read on behind its mistakes, and a record behind its faults: all of them, in one list.
#include "io/config/reading/config_reading.h"

#include <gmock/gmock.h>

#include "io/records/record_faults.h"
#include "tests/io/config_file.h"

namespace howl::config_reading_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> Keys(const ConfigReading& reading) {
  std::vector<std::string> keys;
  for (const UserError& error : reading.mistakes) {
    keys.push_back(std::to_string(error.line()) + " " + error.key());
  }
  return keys;
}

const std::string kNumbers = "frequency_hz: 200, phase_deg: -5, gain: 12}\n";

TEST(ConfigReading, AllMistakesInTheOrderOfTheFile) {
  const ConfigFile file(
      "experiments:\n"
      "  - {name: a, phi: 0.5, " +
      kNumbers + "  - {name: b, fi: 0.5, phi: high, " + kNumbers + "  - {name: a, phi: 0.6, " +
      kNumbers +
      "  - {name: d, phi: 0.6, record: {file: gone.csv, sampling_hz: 5000}}\n"
      "famly: {members: 3}\n"
      "solver: {starts: -1, max_iterations: 3.5}\n"
      "parameters: {xi: {min: 0.3, max: 0.1}}\n");
  const ConfigReading reading = ReadConfigOn(file.Path());
  EXPECT_THAT(Keys(reading),
              ElementsAre("3 experiments[1].phi", "3 experiments[1].fi", "4 experiments[2].name",
                          "5 experiments[3].record.file", "6 famly", "7 solver.max_iterations",
                          "7 solver.starts", "8 parameters.xi.min"));
  ASSERT_TRUE(reading.config);
  EXPECT_EQ(reading.experiments, 4U);
  ASSERT_EQ(reading.config->experiments.size(), 1U);
  EXPECT_EQ(reading.config->experiments[0].experiment.name, "a");
  // The first of them is the one that every other command names.
  EXPECT_EQ(file.Mistake(), reading.mistakes.front().what());
}

TEST(ConfigReading, OtherSectionsMayNameAnExperimentThatHasAMistake) {
  const ConfigFile file(
      "experiments:\n"
      "  - {name: a, phi: 0.5, " +
      kNumbers +
      "  - {name: b, phi: 0.6, gain: 3}\n"
      "residuals: {gain_equality: {experiments: [b]}}\n"
      "parameters: {b.xi: {max: 0.2}}\n");
  EXPECT_THAT(Keys(ReadConfigOn(file.Path())), ElementsAre("3 experiments[1].frequency_hz"));
}

TEST(ConfigReading, WhatIsStillToBeFilledInIsOneLine) {
  const ConfigFile file(
      "experiments:\n"
      "  - {name: a, phi: FILL_IN, " +
      kNumbers + "  - {name: b, phi: FILL_IN, gain: 3}\n");
  EXPECT_THAT(file.Mistake(),
              HasSubstr("config.yaml:2: experiments[0].phi: FILL_IN is still to be replaced (as 1 "
                        "more is), expected a number: the operating parameter"));
  const ConfigReading reading = ReadConfigOn(file.Path());
  EXPECT_THAT(Keys(reading), ElementsAre("2 experiments[0].phi", "3 experiments[1].frequency_hz"));
  EXPECT_FALSE(reading.points_are_known);
  EXPECT_EQ(reading.config->experiments.size(), 1U);
}

TEST(ConfigReading, AnUnknownKeyMayLookLikeThatOfAnExperiment) {
  const ConfigFile file("experiments:\n  - {name: a, phi: 0.5, " + kNumbers +
                        "\"experiments[x]\": 1\n\"experiments[99999999999999999999]\": 1\n"
                        "\"experiments[\": 1\n");
  EXPECT_THAT(
      Keys(ReadConfigOn(file.Path())),
      ElementsAre("3 experiments[x]", "4 experiments[99999999999999999999]", "5 experiments["));
}

TEST(ConfigReading, AGoodConfigIsReadAsEveryCommandReadsIt) {
  const ConfigFile file("experiments:\n  - {name: a, phi: 0.5, " + kNumbers +
                        "solver: {starts: 3}\n");
  const ConfigReading reading = ReadConfigOn(file.Path());
  EXPECT_TRUE(reading.mistakes.empty());
  ASSERT_TRUE(reading.config);
  EXPECT_EQ(reading.config->solver.starts, 3);
  EXPECT_TRUE(reading.points_are_known);
}

TEST(RecordReading, EachFaultOfARecordIsTold) {
  std::string text = "t,p,q\n";
  for (int i = 0; i < 100; ++i) {
    const bool gap = i == 50 || i == 51 || i == 70;
    text += std::to_string(0.001 * i + (i > 80 ? 0.5 : 0.0)) + "," +
            (gap ? "nan" : std::to_string(i % 7)) + "," + (i == 20 ? "x" : std::to_string(i % 5)) +
            "\n";
  }
  const ConfigFile file(
      "experiments:\n  - {name: a, phi: 0.5, record: {file: a.csv, pressure: p, "
      "heat_release: q, time: t}}\n");
  file.Write("a.csv", text);
  const Config config = LoadConfig(file.Path());
  RecordSpec spec = *config.experiments[0].record;
  const RecordReading reading = ReadRecordOn(spec, file.Path().string(), 2);
  EXPECT_FALSE(reading.record);
  std::vector<std::string> told;
  for (const UserError& error : reading.faults) {
    told.push_back(std::to_string(error.line()) + " " + error.key() + ": " + error.mistake());
  }
  EXPECT_THAT(told,
              ElementsAre(HasSubstr("22 q: 'x', expected a number"),
                          HasSubstr("52 p: nan, expected a finite number"),
                          HasSubstr("83 t: a time gap of 0.501 s"),
                          HasSubstr("0 p: no number in 3 of 100 samples (lines 52 to 53, 72)")));
  // Missing columns are told one by one, too.
  spec.pressure = "pressure";
  spec.heat_release = "oh";
  const RecordReading missing = ReadRecordOn(spec, file.Path().string(), 2);
  ASSERT_EQ(missing.faults.size(), 2U);
  EXPECT_EQ(missing.faults[0].key(), "pressure");
  EXPECT_EQ(missing.faults[1].key(), "oh");
}

}  // namespace
}  // namespace howl::config_reading_test
