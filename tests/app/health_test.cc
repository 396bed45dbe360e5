// Bad inputs do not look good: fit and analyse end with what speaks against them; right ones end
// with nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/program.h"

namespace howl::health_test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kAccusations[] = {"\"kind\": \"mistake\"", "\"kind\": \"sampling\"",
                                        "\"kind\": \"guard_rail\"", "\"kind\": \"not_converged\""};

TEST(Health, AnInvertedTransducerIsNoFit) {
  const TemporaryFolder folder;
  const auto config = folder.Write(
      "inverted.yaml",
      "experiments:\n"
      "  - {name: a, phi: 0.5, frequency_hz: 200, phase_deg: 170, gain: 12, flame_slope: -7e-5}\n");
  const ProgramResult fit = RunHowl("fit " + config.string() + " --out " + folder.path().string());
  EXPECT_EQ(fit.status, 1) << fit.out;
  EXPECT_THAT(fit.out, Not(HasSubstr("; converged")));
  EXPECT_THAT(fit.out, HasSubstr("the data look like p or q with the wrong sign"));
  EXPECT_THAT(fit.out, HasSubstr("where the search ends"));
  const std::string solution = ReadFile(folder.path() / "solution.json");
  EXPECT_THAT(solution, HasSubstr("\"converged\": false"));
  EXPECT_THAT(solution, HasSubstr("\"subject\": \"inverted\""));
  // And on top of the report.
  ASSERT_EQ(RunHowl("report " + folder.path().string()).status, 0);
  const std::string page = ReadFile(folder.path() / "report.html");
  EXPECT_THAT(page, HasSubstr("<section id=\"health\">"));
  EXPECT_LT(page.find("<section id=\"health\">"), page.find("<section id=\"data\">"));
}

TEST(Health, PublishedConfigsEndWithNothing) {
  for (const char* name : {"r228", "r228_reliable"}) {
    const TemporaryFolder folder;
    const ProgramResult fit = RunHowl("fit " + Config(name) + " --out " + folder.path().string());
    EXPECT_EQ(fit.status, 0);
    EXPECT_THAT(fit.out, HasSubstr("health: no parameter at a bound, no residual beyond 3"));
    EXPECT_THAT(ReadFile(folder.path() / "solution.json"), HasSubstr("\"health\": []"));
  }
}

TEST(Health, ShippedConfigsAreNotAccused) {
  for (const char* name :
       {"r228", "r228_reliable", "r228_two_modes", "r228_constant_omega", "r228_small_damping"}) {
    const TemporaryFolder folder;
    const std::string out = " --quiet --out " + folder.path().string();
    EXPECT_EQ(RunHowl("fit " + Config(name) + out).status, 0) << name;
    for (const char* accusation : kAccusations) {
      EXPECT_THAT(ReadFile(folder.path() / "solution.json"), Not(HasSubstr(accusation))) << name;
    }
    for (const char* seed : {" --seed 1", " --seed 2"}) {
      ASSERT_EQ(RunHowl("simulate " + Config(name) + out + seed).status, 0);
      const std::string records = (folder.path() / "records.yaml").string();
      EXPECT_EQ(RunHowl("analyse " + records + out).status, 0);
      EXPECT_EQ(RunHowl("fit " + records + out).status, 0) << name << seed;
      for (const char* accusation : kAccusations) {
        EXPECT_THAT(ReadFile(folder.path() / "analysis.json"), Not(HasSubstr(accusation)))
            << name << seed;
        EXPECT_THAT(ReadFile(folder.path() / "solution.json"), Not(HasSubstr(accusation)))
            << name << seed;
      }
    }
  }
}

// Records of one mode at four operating points, and the config that reads them.
class MistakenRecords : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(RunHowl("simulate " + Config("r228_reliable") + Out()).status, 0);
  }
  std::string Out() const { return " --quiet --out " + folder_.path().string(); }
  std::string Loud() const { return " --out " + folder_.path().string(); }
  // records.yaml with `from` replaced by `to` everywhere.
  std::string Changed(const std::string& from, const std::string& to) const {
    std::string text = ReadFile(folder_.path() / "records.yaml");
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
    return folder_.Write("changed.yaml", text).string();
  }
  TemporaryFolder folder_;
};

TEST_F(MistakenRecords, SwappedColumnsAreNamed) {
  const std::string config =
      Changed("pressure: p, heat_release: q", "pressure: q, heat_release: p");
  for (const char* command : {"analyse ", "fit "}) {
    const ProgramResult run = RunHowl(command + config + Loud());
    EXPECT_THAT(run.out, HasSubstr("look like p and q taken for each other")) << command;
  }
}

TEST_F(MistakenRecords, AWrongSignIsNamed) {
  const std::string config = Changed("pressure: p", "pressure_scale: -1, pressure: p");
  const ProgramResult fit = RunHowl("fit " + config + Loud());
  EXPECT_EQ(fit.status, 1);
  EXPECT_THAT(fit.out, HasSubstr("look like p or q with the wrong sign"));
}

// A converter of a few steps shows a tone that is no cycle of the loop's, and any tone a staircase.
TEST_F(MistakenRecords, ARecordOfAFewConverterStepsIsNamed) {
  std::stringstream rows(ReadFile(folder_.path() / "exp1.csv"));
  std::string line;
  std::getline(rows, line);
  std::vector<std::pair<double, std::string>> samples;
  double largest = 0.0;
  while (std::getline(rows, line)) {
    const std::size_t comma = line.find(',');
    samples.emplace_back(std::stod(line.substr(0, comma)), line.substr(comma));
    largest = std::max(largest, std::abs(samples.back().first));
  }
  std::string coarse = "p,q\n";
  for (const auto& [p, rest] : samples) {
    coarse += std::to_string(std::round(8.0 * p / largest)) + rest + "\n";
  }
  folder_.Write("exp1.csv", coarse);
  const std::string config = (folder_.path() / "records.yaml").string();
  for (const char* command : {"analyse ", "fit "}) {
    EXPECT_THAT(RunHowl(command + config + Loud()).out,
                HasSubstr("exp1: p has only 17 different values"))
        << command;
  }
}

TEST_F(MistakenRecords, ATimeColumnInMillisecondsIsNamed) {
  for (const char* header : {"t", "t_ms"}) {
    for (const char* name : {"exp1", "exp2", "exp3", "exp4"}) {
      std::stringstream rows(ReadFile(folder_.path() / (std::string(name) + ".csv")));
      std::string text = std::string(header) + ",p,q\n";
      std::string line;
      std::getline(rows, line);
      for (int i = 0; std::getline(rows, line); ++i) {
        text += std::to_string(i / 5) + "." + std::to_string(2 * (i % 5)) + "," + line + "\n";
      }
      folder_.Write(std::string(name) + "_t.csv", text);
    }
    std::string text = ReadFile(Changed("sampling_hz: 5000", "time: " + std::string(header)));
    for (std::size_t at = text.find(".csv"); at != std::string::npos;
         at = text.find(".csv", at + 6)) {
      text.replace(at, 4, "_t.csv");
    }
    const std::string config = folder_.Write("times.yaml", text).string();
    const ProgramResult run = RunHowl("analyse " + config + Loud());
    EXPECT_EQ(run.status, 0) << run.err;
    const bool named =
        run.out.find("the time column steps by 0.2: if it is in milliseconds") != std::string::npos;
    EXPECT_EQ(named, header == std::string("t")) << run.out;
    const ProgramResult fit = RunHowl("fit " + config + Loud());
    EXPECT_EQ((fit.out + fit.err).find("if it is in milliseconds") != std::string::npos, named);
  }
}

TEST(MeasuredHealth, PublicRecordsAreNotAccused) {
  const char* data = std::getenv("HOWL_DATA");
  if (data == nullptr || *data == '\0') GTEST_SKIP() << "HOWL_DATA is not set";
  for (const char* name : {"turbulent_combustor", "rijke_tube"}) {
    const TemporaryFolder folder;
    const std::string out = " --quiet --out " + folder.path().string();
    ASSERT_EQ(RunHowl("analyse " + Config(name) + out).status, 0);
    const std::string analysis = ReadFile(folder.path() / "analysis.json");
    EXPECT_THAT(analysis, Not(HasSubstr("\"kind\": \"mistake\""))) << name;
    EXPECT_THAT(analysis, Not(HasSubstr("\"kind\": \"sampling\""))) << name;
    EXPECT_THAT(analysis, HasSubstr("\"kind\": \"state\"")) << name;
  }
  // A joint fit of the combustor is a bad one, and no mistake in its data makes it so.
  const TemporaryFolder folder;
  ASSERT_EQ(
      RunHowl("fit " + Config("turbulent_combustor") + " --quiet --out " + folder.path().string())
          .status,
      0);
  const std::string solution = ReadFile(folder.path() / "solution.json");
  EXPECT_THAT(solution, HasSubstr("\"kind\": \"residual\""));
  EXPECT_THAT(solution, Not(HasSubstr("\"kind\": \"mistake\"")));
}

}  // namespace
}  // namespace howl::health_test
