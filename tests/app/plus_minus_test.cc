// One meaning of ±: whatever is printed after it is half of a 95 % interval, 1.96 times the
// standard deviation in the files, and what prints it says so.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::plus_minus_test {
namespace {

using Json = nlohmann::json;

constexpr double kNormalQuantile = 1.96;  // of 0.975: any table of the normal distribution
const char* const kLegend = "±: half of a 95 % interval";

Json ReadJson(const std::filesystem::path& path) { return Json::parse(ReadFile(path)); }

// Every "219.87±0.02" of a line.
std::vector<std::pair<double, double>> ValuesWithError(const std::string& text) {
  static const std::regex pattern("(-?[0-9.]+)±([0-9.]+)");
  std::vector<std::pair<double, double>> out;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    out.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  }
  return out;
}

std::string LineWith(const std::string& text, const std::string& start) {
  std::stringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(start)) return line;
  }
  return "";
}

// The first ± that is printed is the one that says what all others mean.
void ExpectLegendFirst(const std::string& text) {
  const std::size_t first = text.find("±");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(text.substr(first, std::string(kLegend).size()), kLegend) << text;
}

TEST(PlusMinus, FitPrintsHalfOfTheInterval) {
  const TemporaryFolder folder;
  const ProgramResult fit = RunHowl("fit " + Config("r228") + " --out " + folder.path().string());
  ASSERT_EQ(fit.status, 0) << fit.err;
  ExpectLegendFirst(fit.out);
  int seen = 0;
  const Json solution = ReadJson(folder.path() / "solution.json");
  for (const Json& parameter : solution["parameters"]) {
    const auto name = parameter["name"].get<std::string>();
    const std::string line = LineWith(fit.out, name + " = ");
    std::smatch found;
    if (!std::regex_search(line, found, std::regex("± ([0-9.]+) %"))) continue;
    ++seen;
    const double expected = 100.0 * kNormalQuantile * parameter["std_relative"].get<double>();
    EXPECT_NEAR(std::stod(found[1]) / expected, 1.0, 0.05) << line;  // two digits are printed
  }
  EXPECT_EQ(seen, 2);
}

TEST(PlusMinus, AnalysePrintsHalfOfTheInterval) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  ASSERT_EQ(RunHowl("simulate " + Config("r228") + " --quiet" + out).status, 0);
  const ProgramResult analyse =
      RunHowl("analyse " + (folder.path() / "records.yaml").string() + out);
  ASSERT_EQ(analyse.status, 0) << analyse.err;
  ExpectLegendFirst(analyse.out);
  const Json analysis = ReadJson(folder.path() / "analysis.json");
  for (const Json& experiment : analysis["experiments"]) {
    const auto name = experiment["name"].get<std::string>();
    const auto shown = ValuesWithError(LineWith(analyse.out, name + " "));
    const Json& cycle = experiment["cycle"];
    const std::vector<std::pair<Json, double>> expected = {
        {cycle["frequency"], 0.005}, {cycle["phase"], 0.005}, {cycle["gain"], 0.0005}};
    ASSERT_GE(shown.size(), expected.size()) << analyse.out;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const auto& [estimate, rounding] = expected[k];
      EXPECT_NEAR(shown[k].first, estimate["value"].get<double>(), 1.01 * rounding) << name << k;
      EXPECT_NEAR(shown[k].second, kNormalQuantile * estimate["std"].get<double>(), 1.1 * rounding)
          << name << k;
    }
  }
}

}  // namespace
}  // namespace howl::plus_minus_test
