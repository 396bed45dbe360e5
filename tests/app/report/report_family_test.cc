// howl report: what it says where a step is missing, and where loops do not cycle by themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "tests/app/program.h"
#include "tests/app/report/figure_data.h"

namespace howl::report_family_test {
namespace {

using Json = nlohmann::json;

// The paper's table 2: frequency in Hz, phase in degrees, gain.
constexpr std::array<std::array<double, 3>, 6> kTable2 = {{{219.9, -5.74, 12.14},
                                                           {209.1, -9.44, 13.15},
                                                           {205.7, -14.35, 14.79},
                                                           {202.7, -19.18, 16.05},
                                                           {198.4, -22.92, 18.80},
                                                           {179.8, -42.72, 45.01}}};

std::string Page(const TemporaryFolder& folder) { return ReadFile(folder.path() / "report.html"); }

// Without gnuplot, which takes seconds: data, scripts and page are all the same.
void Report(const TemporaryFolder& folder) {
  const std::string command = "PATH=/nowhere " + std::string(HOWL_PROGRAM) + " report " +
                              folder.path().string() + " --quiet";
  ASSERT_EQ(std::system(command.c_str()), 0);
}

// What the page's browser gets.
Json BrowserData(const std::string& page) {
  const std::string start = "id=\"family-data\">";
  const std::size_t from = page.find(start) + start.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

std::string Caption(const std::string& page, const std::string& figure) {
  const std::size_t from = page.find("<figcaption>", page.find("id=\"figure-" + figure + "\""));
  return page.substr(from, page.find("</figcaption>", from) - from);
}

// R228 with every flame slope multiplied.
std::string WithSlopes(double factor) {
  std::string text = ReadFile(Config("r228"));
  std::string out;
  const std::regex slope("flame_slope: (-[0-9.e-]+)");
  std::smatch found;
  while (std::regex_search(text, found, slope)) {
    out += found.prefix().str() + "flame_slope: " + std::to_string(factor * std::stod(found[1]));
    text = found.suffix();
  }
  return out + text;
}

TEST(Report, FamilyAloneOnRecordsFillsTheBrowser) {
  const TemporaryFolder folder;
  const std::string records = (folder.path() / "records").string();
  ASSERT_EQ(RunHowl("simulate " + Config("r228") + " --quiet --out " + records).status, 0);
  const std::string asked = ReadFile(records + "/records.yaml");
  const auto config = folder.Write(
      "records/few.yaml", asked.substr(0, asked.find("\nfamily:")) +
                              "\nfamily: {members: 40, test: {transfer_distance_max: null, "
                              "loop_gain_min: null, xi_max: 0.9}}\n");
  const std::string out = " --quiet --out " + folder.path().string();
  ASSERT_EQ(RunHowl("family " + config.string() + out).status, 0);
  Report(folder);
  const std::string page = Page(folder);
  const Json data = BrowserData(page);
  ASSERT_EQ(data["experiments"].size(), kTable2.size());
  for (std::size_t i = 0; i < kTable2.size(); ++i) {
    const Json& each = data["experiments"][i];
    ASSERT_TRUE(each.contains("frequency_hz")) << each;
    EXPECT_NEAR(each["frequency_hz"][0].get<double>() / kTable2[i][0], 1.0, 0.01);
    EXPECT_NEAR(each["gain"][0].get<double>() / kTable2[i][2], 1.0, 0.05);
    EXPECT_GT(each["gain"][1].get<double>(), 0.0) << "its interval";
    EXPECT_FALSE(each.contains("fit"));
  }
  // There is no joint fit to put a cross at.
  EXPECT_EQ(Caption(page, "bounds").find("joint fit"), std::string::npos)
      << Caption(page, "bounds");
}

// The curve of the trade-off ends low: the members above it have to be inside all the same.
TEST(Report, TradeoffShowsEveryMember) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  std::string text = ReadFile(Config("r228"));
  text.replace(text.find("members: 1000"), 13, "members: 60");
  const std::string few = folder.Write("few.yaml", text).string();
  ASSERT_EQ(RunHowl("family " + few + " --quiet --out " + out).status, 0);
  folder.Write("tradeoff.csv", "omega_spread,xi_max\n0.2,0.06\n0.22,0.05\n");
  Report(folder);
  double spread = 0.0;
  double xi = 0.0;
  for (const Row& row : Curve(FigureData(folder.path(), "tradeoff"), "members")) {
    spread = std::max(spread, row.numbers[0]);
    xi = std::max(xi, row.numbers[1]);
  }
  ASSERT_GT(xi, 0.06);
  const std::string script = ReadFile(folder.path() / "figures" / "tradeoff.gp");
  std::smatch range;
  ASSERT_TRUE(std::regex_search(script, range, std::regex("set yrange \\[0:([0-9.]+)\\]")));
  EXPECT_GE(std::stod(range[1]), xi);
  ASSERT_TRUE(std::regex_search(script, range, std::regex("set xrange \\[0:([0-9.]+)\\]")));
  EXPECT_GE(std::stod(range[1]), spread);
}

// The measured slopes make a loop gain of 0.92: Nyquist's curve is the fitted loop's all the same,
// and what is simulated says that its slope was raised.
TEST(Report, ALoopGainBelowOneIsDrawnAsItWasFitted) {
  const TemporaryFolder folder;
  const auto config =
      folder.Write("weak.yaml", WithSlopes(0.782) + "\nsimulate: {duration_s: 1}\n").string();
  const std::string out = " --quiet --out " + folder.path().string();
  ASSERT_EQ(RunHowl("fit " + config + out).status, 0);
  ASSERT_EQ(RunHowl("family " + config + out).status, 1) << "(1b) is asked for";
  ASSERT_EQ(RunHowl("simulate " + config + out).status, 0);
  Report(folder);
  const Json first = Json::parse(ReadFile(folder.path() / "solution.json"))["experiments"][0];
  const double loop_gain = first["loop_gain"];
  // (1b) by hand: the gain at the limit cycle times 2 pi f times the slope.
  EXPECT_NEAR(loop_gain, 12.14 * 2 * M_PI * 219.9 * 0.782 * 0.703e-4, 0.03);
  bool found = false;
  for (const Row& row : FigureData(folder.path(), "nyquist")) {
    if (!row.curve.starts_with("crossing") || std::abs(row.numbers[2] - 219.9) > 1.5) continue;
    found = true;
    EXPECT_NEAR(row.numbers[0], -loop_gain, 0.005);
  }
  EXPECT_TRUE(found);
  const std::string page = Page(folder);
  EXPECT_NE(Caption(page, "nyquist").find("below the one that (1b) asks"), std::string::npos);
  for (const char* const figure : {"records", "spectra", "flame_scatter", "spectrum_comparison"}) {
    EXPECT_NE(Caption(page, figure).find("slope was raised to a loop gain of 1.1"),
              std::string::npos)
        << figure << ": " << Caption(page, figure);
  }
}

// Conditions that exclude each other stand set by set, and nothing is asked for that an empty
// family does not have.
TEST(Report, AnEmptyFamilyNamesEachSetOfConditions) {
  const TemporaryFolder folder;
  const std::string out = " --quiet --out " + folder.path().string();
  const auto config = folder.Write("tight.yaml", ReadFile(Config("r228")) + "\n").string();
  ASSERT_EQ(RunHowl("fit " + config + out).status, 0);
  folder.Write("family.csv",
               "member,experiment,phi,omega_hz,xi,N,M,tau_s,loop_gain,gain_error,phase_error_deg,"
               "loop_phase_error_deg\n");
  folder.Write("tradeoff.csv", "omega_spread,xi_max\n");
  folder.Write("family.json", R"({"schema": "howl.family/1", "counts": {"members": 0},
      "bounds": {}, "empty_because": ["gain_tolerance", "loop_gain_min", "xi_max"],
      "conflict": {"proved": true, "minimal_sets": [["gain_tolerance", "loop_gain_min"],
      ["xi_max"]], "relaxations": [{"condition": "xi_max", "suffices": false, "value": 0.3,
      "needed": null}, {"condition": "loop_gain_min", "suffices": true, "value": 2,
      "needed": 1.25}]}})");
  Report(folder);
  const std::string page = Page(folder);
  EXPECT_NE(page.find("No model passes the test"), std::string::npos);
  EXPECT_NE(page.find("exclude each other: <code>gain_tolerance</code>, "
                      "<code>loop_gain_min</code></li>"),
            std::string::npos);
  EXPECT_NE(page.find("exclude each other: <code>xi_max</code></li>"), std::string::npos);
  EXPECT_NE(page.find("<code>loop_gain_min</code> is 2; with 1.25 there is a member"),
            std::string::npos);
  EXPECT_EQ(page.find("tradeoff.csv is not usable"), std::string::npos);
}

}  // namespace
}  // namespace howl::report_family_test
