// The first steps with records of one's own: howl init, and howl check of what it wrote.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "tests/app/program.h"

namespace howl::init_check_test {
namespace {

using testing::HasSubstr;
using testing::Not;

// The records of the worked example: p_pa and q_kw, at 5 kHz, which the files do not say.
std::string Record(int number) {
  return std::string(HOWL_SOURCE_DIR) + "/configs/first_rig/exp" + std::to_string(number) +
         ".csv.gz";
}

TEST(InitCommand, WritesAConfigThatOnlyNeedsItsNumbers) {
  const TemporaryFolder folder;
  const std::string config = (folder.path() / "rig.yaml").string();
  const std::string files = Record(1) + " " + Record(2) + " " + Record(3);
  const ProgramResult init = RunHowl("init " + files + " --out " + config);
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.out, HasSubstr("pressure: column p_pa, by its name"));
  EXPECT_THAT(init.out, HasSubstr("(6 places)"));
  // fit says in one line what is left to do ...
  const ProgramResult fit = RunHowl("fit " + config);
  EXPECT_EQ(fit.status, 2);
  EXPECT_THAT(fit.err, HasSubstr("rig.yaml:12: experiments[0].phi: FILL_IN is still to be"));
  EXPECT_EQ(std::count(fit.err.begin(), fit.err.end(), '\n'), 1);
  // ... and so does check.
  const ProgramResult check = RunHowl("check " + config);
  EXPECT_EQ(check.status, 2);
  EXPECT_THAT(check.out, HasSubstr("experiments[0].phi: FILL_IN is still to be"));
  EXPECT_THAT(check.out, HasSubstr("1 error,"));
}

TEST(InitCommand, WithEveryNumberGivenNothingIsLeftToDo) {
  const TemporaryFolder folder;
  const std::string config = (folder.path() / "rig.yaml").string();
  const ProgramResult init =
      RunHowl("init " + Record(1) + " " + Record(2) +
              " --operating-parameter power_kw --values 56,53 --sampling-hz 5000 --out " + config);
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.out, Not(HasSubstr("FILL_IN")));
  EXPECT_THAT(ReadFile(config), HasSubstr("a limit cycle at 219.9 Hz"));
  const ProgramResult check = RunHowl("check " + config);
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("predict: 2 operating points, power_kw 53.00 to 56.00"));
}

TEST(CheckCommand, SaysMistakesAsJsonThoughTheirTextsAreCut) {
  const TemporaryFolder folder;
  std::string wide = "a";
  while (wide.size() < 400) wide += "\xc3\xa8";
  const std::string config =
      folder
          .Write("rig.yaml", "experiments:\n  - {name: a, phi: 0.5, frequency_hz: \"" + wide +
                                 "\", phase_deg: -5, gain: 12}\n\"" + wide + "\": 1\n")
          .string();
  const ProgramResult check = RunHowl("check " + config + " --out " + folder.path().string());
  EXPECT_EQ(check.status, 2);
  const auto json = nlohmann::json::parse(ReadFile(folder.path() / "check.json"));
  EXPECT_EQ(json.at("errors").size(), 2U) << json;
}

TEST(InitCommand, NeverOverwritesAFile) {
  const TemporaryFolder folder;
  const std::string config = folder.Write("rig.yaml", "mine: 1\n").string();
  const ProgramResult init = RunHowl("init " + Record(1) + " --out " + config);
  EXPECT_EQ(init.status, 2);
  EXPECT_EQ(init.err, config +
                          ": --out: is there already and is not overwritten, expected another "
                          "path\n");
  EXPECT_EQ(ReadFile(config), "mine: 1\n");
}

TEST(InitCommand, MistakesAreOneLine) {
  const TemporaryFolder folder;
  const auto error = [](const std::string& arguments) {
    const ProgramResult run = RunHowl("init " + arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    return run.err;
  };
  EXPECT_THAT(error(""), HasSubstr("init: no file given, expected howl init FILE..."));
  EXPECT_THAT(error(Record(1) + " --values 0.5,0.6"),
              HasSubstr("--values: 2 values, expected one for each of 1 files"));
  EXPECT_THAT(error(Record(1) + " --values high"), HasSubstr("expected a number"));
  EXPECT_THAT(error(Record(1) + " --operating-parameter 'air flow'"), HasSubstr("expected a key"));
  EXPECT_THAT(error((folder.path() / "gone.csv").string()), HasSubstr("cannot open"));
  EXPECT_THAT(error(folder.Write("a.txt", "only words\nand more\n").string()), HasSubstr("a.txt:"));
}

TEST(CheckCommand, AGoodConfigHasNothingWrong) {
  const TemporaryFolder folder;
  const ProgramResult check =
      RunHowl("check " + Config("first_rig") + " --out " + folder.path().string());
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("0 errors, 0 warnings"));
  const auto json = nlohmann::json::parse(ReadFile(folder.path() / "check.json"));
  EXPECT_EQ(json["schema"], "howl.check/1");
  EXPECT_TRUE(json["errors"].empty());
  EXPECT_EQ(json["experiments"][0]["record"]["samples"], 10000);
  EXPECT_EQ(json["experiments"][0]["record"]["state"], "limit_cycle");
  for (const char* command : {"analyse", "fit", "family", "predict", "diagnose"}) {
    EXPECT_TRUE(json["commands"][command]["possible"]) << command;
  }
  // As fit itself counts them: 3 experiments of omega, xi, N and tau, and two means.
  EXPECT_EQ(json["commands"]["fit"]["free_parameters"].size(), 14U);
  EXPECT_EQ(json["commands"]["fit"]["tau_s"], "prior");
  EXPECT_EQ(json["commands"]["fit"]["residuals"]["gain_equality"]["blocks"], 3);
}

TEST(CheckCommand, ATableSaysWhatItLacks) {
  const ProgramResult check = RunHowl("check " + Config("r228"));
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("analyse: cannot: no experiment has a record"));
  EXPECT_THAT(check.out, HasSubstr("limit_cycle_gain 4,"));  // of six, two are not reliable
  EXPECT_THAT(check.out, HasSubstr("fit: 6 experiments\n    residuals: gain_equality 6,"));
}

TEST(CheckCommand, ListsEveryErrorAndWarningAtOnce) {
  const TemporaryFolder folder;
  const std::string row = "frequency_hz: 200, phase_deg: -5, gain: 12}\n";
  const std::string record = "record: {file: " + Record(1) + ", pressure: p_pa, heat_release: ";
  const std::string config =
      folder
          .Write("rig.yaml",
                 "experiments:\n"
                 "  - {name: a, phi: 0.5, " +
                     record +
                     "q_kw, sampling_hz: 5000}}\n"
                     "  - {name: b, phi: 0.5, " +
                     record +
                     "q_kw, sampling_hz: 5000}}\n"
                     "  - {name: c, phi: 0.6, " +
                     record +
                     "q_mw, sampling_hz: 5000}}\n"
                     "  - {name: d, phi: 0.7, record: {file: gone.csv, sampling_hz: 1}}\n"
                     "  - {name: e, phi: 0.8, gian: 3, " +
                     row + "family: {members: 0}\n")
          .string();
  const ProgramResult check = RunHowl("check " + config);
  EXPECT_EQ(check.status, 2);
  EXPECT_EQ(check.err, "");
  for (const char* part :
       {"q_mw: no such column", "gone.csv", "experiments[4].gian", "family.members", "4 errors",
        "b: has the same samples of p as a", "b: has the same phi as a"}) {
    EXPECT_THAT(check.out, HasSubstr(part));
  }
  const ProgramResult quiet = RunHowl("check --quiet " + config);
  EXPECT_EQ(quiet.status, 2);
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(std::count(quiet.err.begin(), quiet.err.end(), '\n'), 4);
}

TEST(CheckCommand, AFewWarningsAreNoError) {
  const TemporaryFolder folder;
  const std::string config = folder
                                 .Write("rig.yaml",
                                        "experiments:\n  - {name: a, phi: 0.5, record: "
                                        "{file: " +
                                            Record(1) + ", pressure: p_pa, sampling_hz: 5000}}\n")
                                 .string();
  const ProgramResult check = RunHowl("check " + config);
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("fit: cannot: no record shows a limit cycle in p and q"));
  EXPECT_THAT(check.out, HasSubstr("diagnose: cannot: a has no heat release"));
}

// What diagnose refuses, check says before.
TEST(CheckCommand, SaysThatRecordsAreTooShortForDiagnose) {
  const TemporaryFolder folder;
  std::string rows = "p,q\n";
  for (int i = 0; i < 800; ++i) {
    const double angle = 2.0 * std::numbers::pi * 200.0 * i / 5000.0;
    rows += std::to_string(std::cos(angle)) + "," + std::to_string(std::cos(angle - 1.0)) + "\n";
  }
  folder.Write("a.csv", rows);
  const std::string config =
      folder
          .Write("rig.yaml",
                 "experiments:\n  - {name: a, phi: 0.5, record: "
                 "{file: a.csv, pressure: p, heat_release: q, sampling_hz: 5000}}\n")
          .string();
  const ProgramResult check = RunHowl("check " + config);
  const ProgramResult diagnose =
      RunHowl("diagnose " + config + " --quiet --out " + (folder.path() / "out").string());
  EXPECT_EQ(diagnose.status, 2);
  EXPECT_THAT(diagnose.err, HasSubstr("a holds 32.0 periods at 200.0 Hz, expected at least 50"));
  EXPECT_THAT(check.out, HasSubstr("diagnose: cannot: a holds 32.0 periods at 200.0 Hz"));
}

}  // namespace
}  // namespace howl::init_check_test
