// Malformed configs through the program: one line with file, line and key; exit status 2; no
// output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::malformed_config_test {
namespace {

struct Malformed {
  std::string name;
  std::string text;
  int line;  // that the message names; 0: none
  std::string key;
};

const std::string kGood =
    "experiments:\n"
    "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n";

std::string Row(const std::string& rest) { return "experiments:\n  - {" + rest + "}\n"; }

std::vector<Malformed> AllMalformed() {
  const std::string numbers = "frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14";
  return {
      {"unknown key", kGood + "famly: {members: 3}\n", 3, "famly"},
      {"unknown inner key", kGood + "family:\n  membres: 3\n", 4, "family.membres"},
      {"wrong type", Row("name: a, phi: high, " + numbers), 2, "experiments[0].phi"},
      {"wrong unit in value", Row("name: a, phi: 1, frequency_hz: 219.9 Hz, phase_deg: 0, gain: 1"),
       2, "experiments[0].frequency_hz"},
      {"wrong unit in key", Row("name: a, phi: 1, frequency_khz: 0.2, phase_deg: 0, gain: 1"), 2,
       "experiments[0].frequency_khz"},
      {"missing phi", Row("name: a, " + numbers), 2, "experiments[0].phi"},
      {"missing gain", Row("name: a, phi: 1, frequency_hz: 200, phase_deg: 0"), 2,
       "experiments[0].gain"},
      {"duplicate names", kGood + "  - {name: a, phi: 0.5, " + numbers + "}\n", 3,
       "experiments[1].name"},
      {"negative gain", Row("name: a, phi: 1, frequency_hz: 200, phase_deg: 0, gain: -1"), 2,
       "experiments[0].gain"},
      {"zero frequency", Row("name: a, phi: 1, frequency_hz: 0, phase_deg: 0, gain: 1"), 2,
       "experiments[0].frequency_hz"},
      {"NaN", Row("name: a, phi: 1, frequency_hz: 200, phase_deg: .nan, gain: 1"), 2,
       "experiments[0].phase_deg"},
      {"infinity", Row("name: a, phi: 1, frequency_hz: 200, phase_deg: 0, gain: .inf"), 2,
       "experiments[0].gain"},
      {"rising flame", Row("name: a, phi: 1, flame_slope: 1e-4, " + numbers), 2,
       "experiments[0].flame_slope"},
      {"bounds reversed", kGood + "parameters:\n  xi: {min: 0.3, max: 0.1}\n", 4, "xi"},
      {"empty file", "", 1, "experiments"},
      {"no experiments", "title: none\n", 1, "experiments"},
      // NOLINTNEXTLINE(bugprone-string-constructor): a line as long as this is meant.
      {"10 MB line", kGood + "title: " + std::string(10'000'000, 'x') + "\n", 3, "title"},
      {"no YAML", kGood + "family: {members: 3\n", 3, ""},
      {"tab", kGood + "family:\n\tmembers: 3\n", 4, ""},
      {"alias loop", kGood + "family: &a [*a]\n", 3, "family"},
      {"duplicate key", kGood + "solver: {starts: 3, starts: 4}\n", 3, "solver.starts"},
      {"unknown experiment", kGood + "residuals:\n  gain_equality: {experiments: [b]}\n", 4,
       "residuals.gain_equality.experiments[0]"},
      {"bad expression",
       kGood + "family:\n  predictions:\n    - {name: q, expression: 1 / (2 * }\n", 5,
       "family.predictions[0].expression"},
      {"empty prediction", kGood + "family:\n  predictions:\n    - {name: q}\n", 5,
       "family.predictions[0].expression"},
  };
}

TEST(MalformedConfigs, EachIsOneLineWithFileLineAndKeyAndStatusTwo) {
  const std::vector<Malformed> cases = AllMalformed();
  ASSERT_GE(cases.size(), 20u);
  for (const Malformed& bad : cases) {
    const TemporaryFolder folder;
    const std::string config = folder.Write("bad.yaml", bad.text).string();
    const std::filesystem::path out = folder.path() / "out";
    const ProgramResult run = RunHowl("family " + config + " --out " + out.string());
    EXPECT_EQ(run.status, 2) << bad.name;
    EXPECT_EQ(run.out, "") << bad.name;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << bad.name << "\n" << run.err;
    EXPECT_LT(run.err.size(), 600u) << bad.name;
    EXPECT_THAT(run.err, testing::StartsWith(config + ":" + std::to_string(bad.line) + ": "))
        << bad.name;
    EXPECT_THAT(run.err, testing::HasSubstr(bad.key)) << bad.name;
    EXPECT_THAT(run.err, testing::HasSubstr("expected")) << bad.name;
    EXPECT_FALSE(std::filesystem::exists(out)) << bad.name;
  }
}

}  // namespace
}  // namespace howl::malformed_config_test
