// Every command has one and the same model, the config's: from a fit to records and back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::one_model_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// The experiments of a shipped config, without what follows them.
std::string ExperimentsOf(const std::string& config) {
  const std::string text = ReadFile(Config(config));
  const std::size_t begin = text.find("experiments:");
  return text.substr(begin, text.find("\nfamily:") - begin) + "\n";
}

TEST(LongOneModel, RecordsOfOneModeHaveAFamily) {
  for (const std::string seed : {"1", "2", "3"}) {
    const TemporaryFolder folder;
    const std::string out = " --seed " + seed + " --out " + folder.path().string();
    ASSERT_EQ(RunHowl("simulate " + Config("r228") + out).status, 0);
    const std::string records = (folder.path() / "records.yaml").string();
    // A short list: what counts here is that there is one.
    std::string text = ReadFile(records);
    text.replace(text.find("members: 1000"), 13, "members: 20");
    const std::string config = folder.Write("short.yaml", text).string();
    const ProgramResult analyse = RunHowl("analyse " + config + out);
    EXPECT_THAT(analyse.out, HasSubstr("one mode fitted"));
    const ProgramResult family = RunHowl("family " + config + out);
    EXPECT_EQ(family.status, 0) << family.out << family.err;
    const Json json = Json::parse(ReadFile(folder.path() / "family.json"));
    EXPECT_EQ(json["counts"]["members"], 20);
    // The rig is the joint fit of the published numbers: it lies within the bounds.
    ASSERT_EQ(RunHowl("fit " + Config("r228") + out).status, 0);
    const Json solution = Json::parse(ReadFile(folder.path() / "solution.json"));
    for (const Json& rig : solution["experiments"]) {
      const Json& bounds = json["bounds"][rig["name"].get<std::string>()];
      for (const char* const name : {"omega_hz", "xi", "N", "tau_s"}) {
        EXPECT_LE(bounds[name]["outer"][0].get<double>(), rig[name].get<double>()) << name;
        EXPECT_GE(bounds[name]["outer"][1].get<double>(), rig[name].get<double>()) << name;
      }
    }
  }
}

TEST(OneModel, RecordsCarryWhatStatesTheProblem) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  const std::string config =
      folder
          .Write("problem.yaml",
                 ExperimentsOf("r228_reliable") +
                     "parameters: {xi: {min: 0.02}, exp1.xi: {max: 0.2}}\n"
                     "residuals: {tau_prior: off, damping_prior: {experiments: [exp1, exp2]}}\n"
                     "family: {members: 7, test: {xi_max: 0.4, loop_gain_min: null}}\n")
          .string();
  ASSERT_EQ(RunHowl("simulate " + config + out).status, 0);
  const std::string records = ReadFile(folder.path() / "records.yaml");
  for (const char* const part : {"modes: 1", "min: 0.02", "exp1.xi: {max: 0.2}", "tau_prior: off",
                                 "[exp1, exp2]", "members: 7", "xi_max: 0.4", "loop_gain_min: ~"}) {
    EXPECT_THAT(records, HasSubstr(part));
  }
  const ProgramResult fit = RunHowl("fit " + (folder.path() / "records.yaml").string() + out);
  EXPECT_EQ(fit.status, 0) << fit.err;
}

TEST(OneModel, TheAnalysisBandLimitsTheTransfer) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  ASSERT_EQ(RunHowl("simulate " + Config("r228_reliable") + out).status, 0);
  const std::string config =
      folder
          .Write("band.yaml", ReadFile(folder.path() / "records.yaml") +
                                  "analysis: {min_frequency_hz: 150, max_frequency_hz: 400}\n")
          .string();
  ASSERT_EQ(RunHowl("analyse " + config + out).status, 0);
  std::stringstream rows(ReadFile(folder.path() / "transfer.csv"));
  std::string row;
  std::getline(rows, row);
  int count = 0;
  for (; std::getline(rows, row); ++count) {
    const std::size_t at = row.find(',', row.find(',') + 1) + 1;
    const double frequency_hz = std::stod(row.substr(at));
    EXPECT_GE(frequency_hz, 150.0);
    EXPECT_LE(frequency_hz, 400.0);
  }
  EXPECT_GT(count, 50);
}

TEST(OwnParameter, OneExperimentsIsHeldAlone) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  const std::string config =
      folder
          .Write("own.yaml", ExperimentsOf("r228_reliable") +
                                 "parameters:\n  exp1.xi: {fixed: true, initial: 0.123}\n"
                                 "family: {members: 20}\n")
          .string();
  ASSERT_EQ(RunHowl("fit " + config + out).status, 0);
  const Json solution = Json::parse(ReadFile(folder.path() / "solution.json"));
  EXPECT_NEAR(solution["experiments"][0]["xi"].get<double>(), 0.123, 1e-12);
  EXPECT_GT(std::abs(solution["experiments"][1]["xi"].get<double>() - 0.123), 1e-4);
  const ProgramResult family = RunHowl("family " + config + out);
  ASSERT_EQ(family.status, 0) << family.out << family.err;
  const Json json = Json::parse(ReadFile(folder.path() / "family.json"));
  EXPECT_NEAR(json["bounds"]["exp1"]["xi"]["outer"][0].get<double>(), 0.123, 1e-9);
  EXPECT_NEAR(json["bounds"]["exp1"]["xi"]["outer"][1].get<double>(), 0.123, 1e-9);
  EXPECT_LT(json["bounds"]["exp4"]["xi"]["outer"][0].get<double>(), 0.05);
  // exp1 has the highest phi: no other damps more.
  EXPECT_LE(json["bounds"]["exp4"]["xi"]["outer"][1].get<double>(), 0.123 * (1 + 1e-9));
}

TEST(OwnParameter, MistakesAreNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& command, const std::string& parameters) {
    const std::string config =
        folder.Write("own.yaml", ExperimentsOf("r228_reliable") + parameters).string();
    const ProgramResult run = RunHowl(command + " " + config + " --out " + folder.path().string());
    EXPECT_EQ(run.status, 2);
    return run.err;
  };
  EXPECT_THAT(message("fit", "parameters: {exp9.xi: {max: 0.1}}\n"), HasSubstr("exp9.xi"));
  EXPECT_THAT(message("fit", "parameters: {exp1.xi: {fixed: true}}\n"), HasSubstr("initial"));
  EXPECT_THAT(message("fit", "parameters: {xi: {scope: shared}, exp1.xi: {max: 0.1}}\n"),
              HasSubstr("is shared by all experiments"));
  EXPECT_THAT(message("fit", "parameters: {exp1.M: {max: 9}}\n"),
              HasSubstr("is not a parameter of this model"));
  EXPECT_THAT(message("family", "parameters: {exp1.tau_s: {fixed: true, initial: 0.0034}}\n"),
              HasSubstr("is fixed for one experiment"));
}

}  // namespace
}  // namespace howl::one_model_test
