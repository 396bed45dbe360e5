// howl simulate with the measured flame curve as a table, and with King's law.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "tests/app/program.h"

namespace howl::flame_table_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

double RmsOfPressure(const std::filesystem::path& path) {
  std::istringstream lines(ReadFile(path));
  std::string line;
  std::getline(lines, line);
  double sum = 0.0;
  int n = 0;
  for (; std::getline(lines, line); ++n) sum += std::pow(std::stod(line), 2);
  return n > 0 ? std::sqrt(sum / n) : 0.0;
}

TEST(FlameTable, SimulatesWhatTheRecordShowed) {
  const TemporaryFolder folder;
  const std::string first = (folder.path() / "first").string();
  ASSERT_EQ(RunHowl("simulate " + Config("first_rig") + " --quiet --out " + first).status, 0);
  std::string config = ReadFile(folder.path() / "first" / "records.yaml");
  ASSERT_FALSE(config.empty());
  const auto path = folder.Write("first/table.yaml", config + "\nsimulate: {flame_table: true}\n");
  const ProgramResult result =
      RunHowl("simulate " + path.string() + " --out " + (folder.path() / "second").string());
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("table"));
  for (const char* name : {"lean", "middle", "rich"}) {
    const std::string file = std::string(name) + ".csv";
    EXPECT_NEAR(RmsOfPressure(folder.path() / "second" / file) /
                    RmsOfPressure(folder.path() / "first" / file),
                1.0, 0.05)
        << name;
  }
}

TEST(FlameTable, NeedsARecord) {
  const TemporaryFolder folder;
  const std::string experiments =
      "experiments:\n  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14, "
      "flame_slope: -0.703e-4}\n";
  const auto bare = folder.Write("bare.yaml", experiments + "simulate: {flame_table: true}\n");
  const ProgramResult without =
      RunHowl("simulate " + bare.string() + " --out " + (folder.path() / "out").string());
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.err, AllOf(HasSubstr("bare.yaml:3: simulate.flame_table: "),
                                 HasSubstr("expected records of p and q")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "a.csv"));
  const auto both =
      folder.Write("both.yaml", experiments + "simulate: {flame_table: true, flame_shape: tanh}\n");
  EXPECT_EQ(RunHowl("simulate " + both.string()).status, 2);
}

// The loop gain at rest exceeds one, so that a cycle grows out of rest; it is not symmetric, as
// King's law is not.
TEST(KingsLaw, CyclesOutOfRest) {
  const TemporaryFolder folder;
  const auto config = folder.Write(
      "king.yaml",
      "experiments:\n  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14, "
      "flame_slope: -0.703e-4}\nsimulate: {flame_shape: square_root, start: rest, duration_s: "
      "2}\n");
  const ProgramResult result =
      RunHowl("simulate " + config.string() + " --out " + (folder.path() / "out").string());
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("square_root"));
  EXPECT_GT(RmsOfPressure(folder.path() / "out" / "a.csv"), 1.0);  // |q| is of order one, gain 12
}

}  // namespace
}  // namespace howl::flame_table_test
