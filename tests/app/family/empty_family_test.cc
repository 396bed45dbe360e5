// The lines that an empty family prints, pasted into its config as a user would: each gives a
// family, and one per cent less of its change gives none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::empty_family_test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

void Replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

// "..., KEY: VALUE}..." of the line, put in place of what the config has behind that key: behind
// the experiment's name where the line has one. Another value than the line's where one is given.
std::string Pasted(std::string config, const std::string& line, const std::string& value = "") {
  std::smatch parts;
  EXPECT_TRUE(std::regex_search(line, parts, std::regex("(\\w+): ([-+.0-9e]+|false)\\}")));
  std::size_t from = 0;
  std::smatch name;
  if (std::regex_search(line, name, std::regex("name: (\\w+),"))) {
    from = config.find("name: " + name[1].str() + ",");
    EXPECT_NE(from, std::string::npos);
  }
  std::smatch parameter;
  if (std::regex_search(line, parameter, std::regex("parameters: \\{(\\w+): "))) {
    from = config.find(parameter[1].str() + ": {");
    EXPECT_NE(from, std::string::npos);
  }
  const std::string key = parts[1].str() + ": ";
  const std::string to = key + (value.empty() ? parts[2].str() : value);
  const std::size_t end_of_line = config.find('\n', from);
  const std::size_t at = config.find(key, from);
  if (name.empty() || at < end_of_line) {
    EXPECT_NE(at, std::string::npos) << key;
    return config.replace(at, config.find_first_of(",}", at) - at, to);
  }
  return config.insert(config.find('}', from), ", " + to);  // a key that the experiment has not
}

std::string Number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

struct Tried {
  int lines = 0;
  int less = 0;
};

// The lines of the changes named; each other line is only looked for in what is printed.
Tried TryLines(const TemporaryFolder& folder, const std::string& config,
               const std::vector<std::string>& names) {
  Tried tried;
  const std::string out = " --out " + (folder.path() / "out").string();
  const ProgramResult empty =
      RunHowl("family " + folder.Write("empty.yaml", config).string() + out);
  if (empty.status != 1) {
    ADD_FAILURE() << empty.out << empty.err;
    return tried;
  }
  const Json json = Json::parse(ReadFile(folder.path() / "out" / "family.json"));
  for (const Json& change : json["conflict"]["changes"]) {
    if (change["line"].is_null()) continue;
    const std::string line = change["line"];
    SCOPED_TRACE(line);
    EXPECT_THAT(empty.out, HasSubstr("  " + line + "  # "));
    ++tried.lines;
    if (std::ranges::find(names, change["name"].get<std::string>()) == names.end()) continue;
    const auto with = folder.Write("with.yaml", Pasted(config, line));
    EXPECT_EQ(RunHowl("family --quiet " + with.string() + out).status, 0);
    const Json found = Json::parse(ReadFile(folder.path() / "out" / "family.json"));
    EXPECT_GE(found["counts"]["members"], 1);
    if (!change["pasted"].is_number()) continue;
    ++tried.less;
    const double value = change["value"];
    const double less = value + 0.99 * (change["pasted"].get<double>() - value);
    const auto short_of = folder.Write("less.yaml", Pasted(config, line, Number(less)));
    EXPECT_EQ(RunHowl("family --quiet " + short_of.string() + out).status, 1);
  }
  return tried;
}

// Few members and wide bounds: what is tested is whether there is any.
std::string QuickR228() {
  std::string config = ReadFile(Config("r228"));
  Replace(config, "members: 1000", "width: 0.3\n  members: 60");
  return config;
}

TEST(EmptyFamily, EachLineOfThePublishedTableGivesAFamily) {
  const TemporaryFolder folder;
  std::string config = QuickR228();
  Replace(config, "omega_spread_max: 0.25", "omega_spread_max: 0.15");
  const Tried tried =
      TryLines(folder, config, {"phase_tolerance_deg", "omega_spread_max", "xi_max"});
  EXPECT_EQ(tried.lines, 7);  // three limits; f and phase of the experiments at both ends of phi
  EXPECT_EQ(tried.less, 3);
}

TEST(EmptyFamily, EachLineForTheLeastLoopGainGivesAFamily) {
  const TemporaryFolder folder;
  std::string config = QuickR228();
  Replace(config, "loop_gain_min: 1.0", "loop_gain_min: 1.2");
  const Tried tried =
      TryLines(folder, config, {"loop_gain_min", "exp1.flame_slope", "exp1.reliable"});
  EXPECT_EQ(tried.lines, 6);  // two limits; f, gain, slope of exp1, and that it is reliable
  EXPECT_EQ(tried.less, 2);
}

// Rows 1 and 6 of the paper's tables.
TEST(EmptyFamily, TwoModes) {
  const TemporaryFolder folder;
  const Tried tried = TryLines(
      folder,
      "experiments:\n"
      "  - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,"
      " flame_slope: -0.703e-4}\n"
      "  - {name: exp6, phi: 0.45, frequency_hz: 179.8, phase_deg: -42.72, gain: 45.01}\n"
      "model: {modes: 2}\n"
      "parameters: {omega_hz: {min: 150}, xi: {min: 0.02}, M: {scope: shared, max: 5000}}\n"
      "family: {members: 60, width: 0.3, test: {omega_spread_max: 0.1, xi_max: 0.2,"
      " phase_tolerance_deg: 0.5}}\n",
      {"omega_spread_max", "exp6.frequency_hz"});
  EXPECT_GE(tried.lines, 5);
  EXPECT_EQ(tried.less, 2);
}

// Data that a record gives cannot be pasted: the limits can.
TEST(LongEmptyFamily, RecordsHaveLinesForTheLimitsAlone) {
  const TemporaryFolder folder;
  const std::string rig = folder.path().string() + "/rig";
  ASSERT_EQ(RunHowl("simulate " + Config("r228_reliable") + " --out " + rig).status, 0);
  std::string config = ReadFile(rig + "/records.yaml");
  config = std::regex_replace(config, std::regex("file: \""), "file: \"rig/");
  config = config.substr(0, config.find("\nfamily:"));  // the last section, for another one
  config +=
      "\nfamily: {members: 20, width: 0.3, test: {xi_max: 0.05, transfer_distance_max: 4.0}}\n";
  const Tried tried = TryLines(folder, config, {"xi_max", "transfer_distance_max"});
  EXPECT_EQ(tried.lines, 2);
  EXPECT_EQ(tried.less, 2);
}

}  // namespace
}  // namespace howl::empty_family_test
