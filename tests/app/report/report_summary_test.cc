// What the report says first, against the files that it reads and against the paper's tables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "tests/app/program.h"
#include "tests/app/report/figure_data.h"

namespace howl::report_summary_test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Out(const TemporaryFolder& folder) {
  return " --quiet --out " + (folder.path() / "out").string();
}

// Without gnuplot, which takes seconds: data, scripts and page are all the same.
std::string Page(const TemporaryFolder& folder) {
  const std::string command = "PATH=/nowhere " + std::string(HOWL_PROGRAM) + " report " +
                              (folder.path() / "out").string() + " --quiet";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return ReadFile(folder.path() / "out" / "report.html");
}

std::string Summary(const std::string& page) {
  const std::size_t from = page.find("<section id=\"summary\">");
  if (from == std::string::npos) return "";
  return page.substr(from, page.find("</section>", from) - from);
}

TEST(ReportSummary, SaysOfR228WhatThePaperAndTheFilesSay) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunHowl("fit " + Config("r228") + Out(folder)).status, 0);
  std::string summary = Summary(Page(folder));
  // Table 2: 179.8 to 219.9 Hz; the first four are stationary, their loop gains 1.18 to 1.28.
  EXPECT_THAT(summary,
              HasSubstr("All 6 experiments (phi 0.45 to 0.56) show a limit cycle, at 180 to "
                        "220 Hz; 4 of them are reliable."));
  EXPECT_THAT(summary, HasSubstr("above one in every reliable experiment"));
  EXPECT_THAT(summary, HasSubstr("howl family says what the data leave open."));
  EXPECT_THAT(summary, HasSubstr("Records of exp5 and exp6"));
  const Json solution = Json::parse(ReadFile(folder.path() / "out" / "solution.json"));
  const std::size_t open = solution["identifiability"]["undetermined"].size();
  EXPECT_THAT(summary, HasSubstr(std::to_string(open) + " directions"));

  ASSERT_EQ(RunHowl("predict " + Config("r228") + " --at 0.5,0.52" + Out(folder)).status, 0);
  ASSERT_EQ(RunHowl("family " + Config("r228") + Out(folder)).status, 0);
  const std::string page = Page(folder);
  summary = Summary(page);
  EXPECT_THAT(summary, HasSubstr("1000 models that the data cannot reject are listed."));
  EXPECT_THAT(summary, Not(HasSubstr("howl family says")));
  // Guaranteed bounds of the reference experiment, to the three digits that are shown.
  const Json family = Json::parse(ReadFile(folder.path() / "out" / "family.json"));
  const Json& tau = family["bounds"]["exp1"]["tau_s"]["outer"];
  std::smatch found;
  ASSERT_TRUE(std::regex_search(summary, found, std::regex("the delay ([0-9.]+) to ([0-9.]+) ms")));
  EXPECT_NEAR(std::stod(found[1]), 1e3 * tau[0].get<double>(), 0.0051);
  EXPECT_NEAR(std::stod(found[2]), 1e3 * tau[1].get<double>(), 0.0051);
  // Where the cycle begins.
  const Json prediction = Json::parse(ReadFile(folder.path() / "out" / "prediction.json"));
  ASSERT_TRUE(std::regex_search(summary, found, std::regex("it begins at ([0-9.]+) \\(95 %")));
  EXPECT_NEAR(std::stod(found[1]), prediction["cycle"]["begins"]["value"].get<double>(), 5.1e-5);
  // Two predicted points, each a row of the table.
  EXPECT_THAT(page, HasSubstr("What to expect where nobody measured"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">0.52</th><td>between</td>"));
}

TEST(ReportSummary, SaysWhyAFamilyIsEmptyAndWhatWouldDo) {
  const TemporaryFolder folder;
  const std::string config =
      folder.Write("flat.yaml",
                   "experiments:\n"
                   "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,"
                   " flame_slope: -0.48e-4}\n"
                   "  - {name: b, phi: 0.51, frequency_hz: 205.7, phase_deg: -14.35, gain: 14.79,"
                   " flame_slope: -0.42e-4}\n");
  ASSERT_EQ(RunHowl("family " + config + Out(folder)).status, 1);
  std::string summary = Summary(Page(folder));
  EXPECT_THAT(summary, HasSubstr("not above one in a and b"));
  EXPECT_THAT(summary, HasSubstr("No model passes the test"));
  EXPECT_THAT(summary, HasSubstr("howl family --without NAME leaves a condition out."));
  ASSERT_EQ(RunHowl("family " + config + " --without loop_gain_min" + Out(folder)).status, 0);
  summary = Summary(Page(folder));
  EXPECT_THAT(summary, HasSubstr("asked for without loop_gain_min"));
  EXPECT_THAT(summary, Not(HasSubstr("No model passes")));
}

TEST(ReportSummary, SaysTheVerdictAndTheAdvice) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "out");
  folder.Write("out/diagnosis.json",
               R"({"schema": "howl.diagnosis/1",
                   "verdict": {"kind": "effect", "effect": "q_sensor_lowpass<b>",
                   "indistinguishable": ["channel_skew"],
                   "probability": {"q_sensor_lowpass<b>": 0.91}},
                   "gap": {"before": 0.8, "after": 0.1, "floor": 0.05},
                   "advice": "a sweep, would tell more"})");
  const std::string summary = Summary(Page(folder));
  EXPECT_THAT(summary, HasSubstr("falls short of the rig by: q_sensor_lowpass&lt;b&gt;."));
  EXPECT_THAT(summary,
              HasSubstr("probability of 0.91; the data cannot tell it from channel_skew."));
  EXPECT_THAT(summary, HasSubstr("the model is 0.8, with the best candidate 0.1; a perfect model "
                                 "would leave 0.05."));
  EXPECT_THAT(summary, HasSubstr("A sweep, would tell more."));
}

TEST(ReportSummary, AFieldOfAnotherTypeLeavesThePageWhole) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "out");
  folder.Write(
      "out/prediction.json",
      R"({"schema": "howl.prediction/1", "points": [3, {"phi": 1, "share_unstable": 0.5}], "cycle": [1],
                   "map": {"x": 2}, "flame": 7})");
  folder.Write("out/prediction_map.csv", "phi,tau_s,growth_rate_1_s\n1,2,3\n");
  folder.Write("out/family.json", R"({"schema": "howl.family/1", "bounds": 3})");
  folder.Write("out/diagnosis.json",
               R"({"schema": "howl.diagnosis/1", "verdict": {"kind": "none"}, "gap": "?"})");
  const std::string page = Page(folder);
  EXPECT_THAT(page, HasSubstr("</html>"));
  EXPECT_THAT(page, HasSubstr("What is missing"));
}

// Numbers have three digits to read, and are whole on hover.
TEST(ReportTables, ThreeDigitsAndTheWholeNumber) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunHowl("fit " + Config("r228") + Out(folder)).status, 0);
  const std::string page = Page(folder);
  EXPECT_THAT(page, HasSubstr("<td title=\"219.9\">220</td>"));
  EXPECT_THAT(page, HasSubstr("<td>−5.74</td>"));
  const Json solution = Json::parse(ReadFile(folder.path() / "out" / "solution.json"));
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      page, found,
      std::regex("<th scope=\"row\">exp1</th><td>0.56</td><td title=\"([^\"]+)\">217<")));
  EXPECT_THAT(page, HasSubstr(">4980</td>"));  // N of experiment 1: no power of ten
  EXPECT_DOUBLE_EQ(std::stod(found[1]), solution["experiments"][0]["omega_hz"].get<double>());
}

// A line that is no multiple of the fundamental has an empty cell in lines.csv.
TEST(ReportLines, ThoseThatAreNoHarmonicsAreDrawn) {
  const TemporaryFolder folder;
  const std::string config = folder.Write(
      "two.yaml",
      "experiments:\n"
      "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
      "  - {name: b, phi: 0.51, frequency_hz: 205.7, phase_deg: -14.35, gain: 14.79}\n");
  ASSERT_EQ(RunHowl("fit " + config + Out(folder)).status, 0);
  folder.Write("out/lines.csv",
               "name,phi,frequency_hz,frequency_std_hz,harmonic\n"
               "a,0.56,219.9,0.1,1\na,0.56,751.2,0.3,\n");
  EXPECT_THAT(Page(folder), Not(HasSubstr("lines.csv is not usable")));
  EXPECT_THAT(ReadFile(folder.path() / "out" / "figures" / "lines.csv"), HasSubstr("751.2"));
}

// The boundary that is drawn is where the map's growth rate is zero.
TEST(ReportStabilityMap, TheBoundaryLiesBetweenGrowthAndDecay) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      RunHowl("predict " + Config("r228_reliable") +
              " --map phi:tau_s --map-x 0.49:0.56:0.01 --map-y 0.002:0.005:0.0001" + Out(folder))
          .status,
      0);
  const std::string page = Page(folder);
  EXPECT_THAT(page, HasSubstr("id=\"figure-stability_map\""));
  const Json points = Json::parse(ReadFile(folder.path() / "out" / "prediction.json"))["points"];
  const auto predicted = Curve(FigureData(folder.path() / "out", "prediction"), "prediction");
  ASSERT_EQ(predicted.size(), points.size());
  for (const Json& point : points) {
    const auto row = std::ranges::find_if(
        predicted, [&](const Row& each) { return each.numbers[0] == point["phi"].get<double>(); });
    ASSERT_NE(row, predicted.end());
    EXPECT_EQ(row->numbers[1], point["frequency_hz"]["value"].get<double>());
    EXPECT_EQ(row->numbers[6], point["growth_rate_1_s"]["hi"].get<double>());
  }
  const auto rows = FigureData(folder.path() / "out", "stability_map");
  const auto boundary = Curve(rows, "boundary");
  ASSERT_GT(boundary.size(), 5u);
  EXPECT_FALSE(Curve(rows, "boundary_lo").empty());
  EXPECT_FALSE(Curve(rows, "boundary_hi").empty());
  EXPECT_EQ(Curve(rows, "members").size(), 4u);
  const auto cells = Curve(rows, "growth");
  EXPECT_EQ(cells.size(), 8u * 31u);
  for (const Row& segment : boundary) {
    // Of the cells around the segment's middle some grow and some decay.
    const double x = segment.numbers[0] + 0.5 * segment.numbers[2];
    const double y = segment.numbers[1] + 0.5 * segment.numbers[3];
    bool grows = false, decays = false;
    for (const Row& cell : cells) {
      const bool near =
          std::abs(cell.numbers[0] - x) <= 0.0101 && std::abs(cell.numbers[1] - y) <= 0.101;
      if (!near) continue;
      (cell.numbers[6] > 0.0 ? grows : decays) = true;
    }
    EXPECT_TRUE(grows && decays) << x << " " << y;
  }
}

}  // namespace
}  // namespace howl::report_summary_test
