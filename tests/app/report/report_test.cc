// howl report: figures of R228 against the paper's own numbers, and a report that shows the rest
// whatever is missing.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"
#include "tests/app/report/figure_data.h"

namespace howl::report_test {
namespace {

using testing::Test;

bool HasGnuplot() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

// One folder with everything for R228, made once.
class ReportOfR228 : public Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const std::string out = " --quiet --out " + folder_->path().string();
    ASSERT_EQ(RunHowl("fit " + Config("r228") + out).status, 0);
    ASSERT_EQ(RunHowl("family " + Config("r228") + out).status, 0);
    report_ = RunHowl("report " + folder_->path().string());
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::vector<Row> Data(const std::string& name) {
    return FigureData(folder_->path(), name);
  }
  static std::string Page() { return ReadFile(folder_->path() / "report.html"); }

  static TemporaryFolder* folder_;
  static ProgramResult report_;
};

TemporaryFolder* ReportOfR228::folder_ = nullptr;
ProgramResult ReportOfR228::report_;

TEST_F(ReportOfR228, LoopGainsAreThoseOfTables2And3) {
  ASSERT_EQ(report_.status, 0) << report_.err;
  const auto rows = Data("loop_gain");
  const auto measured = Curve(rows, "measured");
  const std::vector<double> expected = {1.179, 1.221, 1.281, 1.280};
  ASSERT_EQ(measured.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(measured[i].numbers[1], expected[i], 1e-3);
  }
  const auto unreliable = Curve(rows, "not stationary");
  ASSERT_EQ(unreliable.size(), 2U);
  EXPECT_NEAR(unreliable[0].numbers[1], 0.940, 1e-3);
  EXPECT_NEAR(unreliable[1].numbers[1], 0.443, 1e-3);
  const auto vanishes = Curve(rows, "vanishes");
  ASSERT_EQ(vanishes.size(), 1U);
  EXPECT_NEAR(vanishes[0].numbers[0], 0.675, 5e-4);
}

TEST_F(ReportOfR228, DelaysAreThoseOfEquation3) {
  const auto rows = Data("delay");
  std::vector<double> delays;
  for (const Row& row : rows) {
    if (row.curve.starts_with("delay")) delays.push_back(row.numbers[1]);
  }
  const std::vector<double> expected = {3.338, 3.461, 3.452, 3.437, 3.459, 3.511};
  ASSERT_EQ(delays.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(delays[i], expected[i], 5e-4);
}

TEST_F(ReportOfR228, MembersPassThroughTheMeasuredPoint) {
  const auto rows = Data("bode_family");
  std::map<std::string, double> nearest;
  std::map<std::string, double> gain;
  for (const Row& row : rows) {
    if (!row.curve.starts_with("member")) continue;
    const double distance = std::abs(row.numbers[0] - 219.9);
    if (!nearest.contains(row.curve) || distance < nearest[row.curve]) {
      nearest[row.curve] = distance;
      gain[row.curve] = row.numbers[1];
    }
  }
  ASSERT_GE(gain.size(), 20U);
  // To the test's gain_tolerance.
  for (const auto& [member, value] : gain) EXPECT_NEAR(value, 12.14, 0.0101 * 12.14) << member;
}

TEST_F(ReportOfR228, HarmonicsAreMultiplesOfTheMeasuredFrequency) {
  const auto third = Curve(Data("lines"), "harmonic 3");
  ASSERT_EQ(third.size(), 6U);
  EXPECT_NEAR(third[0].numbers[1], 659.7, 1e-9);
  EXPECT_NEAR(third[5].numbers[1], 539.4, 1e-9);
}

// (1a): the loop's phase is 180 degrees at the limit cycle, and there its gain is figure 7's.
TEST_F(ReportOfR228, NyquistCrossesTheNegativeAxisAtTheLimitCycle) {
  bool found = false;
  for (const Row& row : Data("nyquist")) {
    if (!row.curve.starts_with("crossing")) continue;
    if (std::abs(row.numbers[2] - 219.9) > 1.0) continue;
    found = true;
    EXPECT_NEAR(row.numbers[0], -1.179, 0.01);
    EXPECT_EQ(row.numbers[1], 0.0);
  }
  EXPECT_TRUE(found);
}

// Three per cent of tau are more than 20 degrees at 750 Hz (the paper: more than 50 in all).
TEST_F(ReportOfR228, DelaySensitivityIsTheDelaysOwn) {
  const auto rows = Data("sensitivity_tau");
  ASSERT_GE(rows.size(), 6U);
  const double lowest = rows[1].numbers[1] / rows[1].numbers[0];
  const double highest = rows[5].numbers[1] / rows[5].numbers[0];
  EXPECT_GT((lowest - highest) * 750.0, 50.0);
}

TEST_F(ReportOfR228, EveryFigureHasItsFourFiles) {
  if (!HasGnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const std::string page = Page();
  int figures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_->path() / "figures")) {
    if (entry.path().extension() != ".gp") continue;
    ++figures;
    for (const char* ending : {".csv", ".svg", ".pdf"}) {
      auto file = entry.path();
      file.replace_extension(ending);
      ASSERT_TRUE(std::filesystem::exists(file)) << file;
      EXPECT_GT(std::filesystem::file_size(file), 100U) << file;
    }
    EXPECT_NE(page.find("id=\"figure-" + entry.path().stem().string() + "\""), std::string::npos)
        << entry.path();
  }
  EXPECT_GE(figures, 10);
}

TEST_F(ReportOfR228, ThePageAsksForNothingElse) {
  const std::string page = Page();
  for (const char* foreign : {"src=\"http", "href=\"http", "@import", "url(http", "fetch("}) {
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  }
  EXPECT_NE(page.find("Leon Sorokin"), std::string::npos) << "the plotting library's licence";
}

TEST_F(ReportOfR228, SaysThatNothingIsMissing) {
  EXPECT_EQ(Page().find("What is missing"), std::string::npos);
}

// Tables and sentences fit a terminal of 100 columns, and are plain where they are piped.
TEST_F(ReportOfR228, TerminalTextFitsAHundredColumns) {
  const std::string out = " --out " + folder_->path().string();
  for (const std::string command : {"fit", "list"}) {
    const ProgramResult result = RunHowl(command + " " + Config("r228") + out);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out.find('\033'), std::string::npos) << "colours in a pipe";
    EXPECT_EQ(result.err, "") << "progress in a pipe";
    std::stringstream lines(result.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      if (line.starts_with("written")) continue;
      EXPECT_LE(line.size(), 100U) << line;
    }
    EXPECT_GT(count, 10);
  }
}

TEST(Report, SaysWhatIsHalfWrittenAndShowsTheRest) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  ASSERT_EQ(RunHowl("fit " + Config("r228") + " --quiet --out " + out).status, 0);
  const std::string solution = ReadFile(folder.path() / "solution.json");
  folder.Write("solution.json", solution.substr(0, solution.size() / 2));
  folder.Write("family.json", "{\"schema\": \"howl.family/1\", \"bounds\": {\"exp1\": 3}}");
  folder.Write("tradeoff.csv", "omega_spread,xi_max\n0.1\n");
  const ProgramResult result = RunHowl("report " + out);
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string page = ReadFile(folder.path() / "report.html");
  EXPECT_NE(page.find("solution.json is not usable (half written)"), std::string::npos);
  EXPECT_NE(page.find("tradeoff.csv is not usable (line 2 has 1 cells, expected 2)"),
            std::string::npos);
  EXPECT_NE(page.find("howl family has not run here"), std::string::npos);
  // The published characteristics need none of these files.
  EXPECT_EQ(Curve(FigureData(folder.path(), "loop_gain"), "measured").size(), 4U);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "figures" / "bode_all.gp"));
}

TEST(Report, WithoutGnuplotTheRestIsShown) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  ASSERT_EQ(RunHowl("fit " + Config("r228") + " --quiet --out " + out).status, 0);
  const std::string command =
      "PATH=/nowhere " + std::string(HOWL_PROGRAM) + " report " + out + " --quiet";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string page = ReadFile(folder.path() / "report.html");
  EXPECT_NE(page.find("gnuplot is not installed"), std::string::npos);
  EXPECT_NE(page.find("title=\"219.9\""), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "figures" / "delay.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "figures" / "delay.svg"));
}

TEST(Report, AFolderWithNothingIsAMistake) {
  const TemporaryFolder folder;
  const ProgramResult result = RunHowl("report " + folder.path().string());
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("holds nothing to report"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "report.html"));
  EXPECT_EQ(RunHowl("report " + (folder.path() / "none").string()).status, 2);
}

TEST(Report, FindsTheConfigThatMovedAway) {
  const TemporaryFolder folder;
  const auto config = folder.Write("problem.yaml", ReadFile(Config("r228")));
  const std::string out = (folder.path() / "out").string();
  ASSERT_EQ(RunHowl("fit " + config.string() + " --quiet --out " + out).status, 0);
  std::filesystem::remove(config);
  ASSERT_EQ(RunHowl("report " + out + " --quiet").status, 0);
  const std::string page = ReadFile(folder.path() / "out" / "report.html");
  EXPECT_NE(page.find("is no longer where it was"), std::string::npos);
  EXPECT_NE(page.find("R228, six experiments"), std::string::npos);
}

TEST(Report, SaysWhatGoesWithAnUnknown) {
  TemporaryFolder folder;
  folder.Write("diagnosis.json",
               R"({"schema": "howl.diagnosis/1",
                   "verdict": {"kind": "unknown", "effect": null,
                   "together": "channel_skew+mode_detuning",
                   "indistinguishable": [], "probability": {"unknown": 0.93}}})");
  const ProgramResult result = RunHowl("report " + folder.path().string());
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string page = ReadFile(folder.path() / "report.html");
  EXPECT_NE(page.find("unknown</strong> (probability 0.93)"), std::string::npos);
  EXPECT_NE(page.find("channel_skew+mode_detuning together"), std::string::npos);
}

TEST(Report, NamesAreTextWhateverTheyHold) {
  const TemporaryFolder folder;
  std::string text = ReadFile(Config("r228"));
  const std::string nasty = "\"a_b^{c}<i>`id`&amp;\"";
  for (std::size_t at = text.find("name: exp1"); at != std::string::npos;
       at = text.find("name: exp1", at + 1)) {
    text.replace(at + 6, 4, nasty);
  }
  const auto config = folder.Write("problem.yaml", text);
  const std::string out = (folder.path() / "out").string();
  const ProgramResult fit = RunHowl("fit " + config.string() + " --quiet --out " + out);
  ASSERT_EQ(fit.status, 0) << fit.err;
  const ProgramResult result = RunHowl("report " + out);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.find("could not draw"), std::string::npos) << result.out;
  const std::string page = ReadFile(folder.path() / "out" / "report.html");
  EXPECT_EQ(page.find("<i>"), std::string::npos);
}

}  // namespace
}  // namespace howl::report_test
