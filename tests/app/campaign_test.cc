// Many rigs to one table: from configs, a table of rigs, a grid of values; in shards; resumed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "io/report/csv_table.h"
#include "tests/app/program.h"

namespace howl::campaign_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kTable =
    "experiments:\n"
    "  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}\n"
    "  - {name: exp2, phi: 0.60, frequency_hz: 214, phase_deg: -10, gain: 11}\n";

class Campaign : public ::testing::Test {
 protected:
  // Runs howl campaign, or another command, on what the folder has.
  ProgramResult Run(const std::string& text, const std::string& out,
                    const std::string& options = "") {
    const fs::path file = folder_.Write("campaign.yaml", text);
    return RunHowl("campaign " + file.string() + " --out " + Path(out) + options);
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  CsvTable Table(const std::string& out, const std::string& file = "campaign.csv") const {
    return ReadCsvTable(folder_.path() / out / file);
  }
  nlohmann::json Json(const std::string& file) const {
    return nlohmann::json::parse(ReadFile(folder_.path() / file));
  }
  std::vector<std::string> Column(const CsvTable& table, const std::string& column) const {
    std::vector<std::string> cells;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      cells.push_back(table.Text(row, column));
    }
    return cells;
  }

  TemporaryFolder folder_;
  fs::path config_ = folder_.Write("rig.yaml", kTable);
};

TEST_F(Campaign, ARowIsWhatTheCommandsSayAlone) {
  ASSERT_EQ(RunHowl("fit " + config_.string() + " --out " + Path("alone")).status, 0);
  ASSERT_EQ(RunHowl("family " + config_.string() + " --out " + Path("alone")).status, 0);
  const ProgramResult result = Run("configs: [rig.yaml]\n", "all");
  EXPECT_EQ(result.status, 0) << result.err;
  const CsvTable table = Table("all");
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.Number(0, "fit_cost"), Json("alone/solution.json")["cost"]);
  EXPECT_EQ(table.Number(0, "members"), Json("alone/family.json")["counts"]["members"]);
  const CsvTable points = Table("all", "campaign_points.csv");
  const auto solution = Json("alone/solution.json");
  const auto family = Json("alone/family.json");
  std::size_t compared = 0;
  for (std::size_t row = 0; row < points.rows.size(); ++row) {
    if (points.Text(row, "experiment") != "exp2" || points.Text(row, "quantity") != "tau_s") {
      continue;
    }
    EXPECT_EQ(points.Number(row, "value"), solution["experiments"][1]["tau_s"]);
    EXPECT_EQ(points.Number(row, "outer_lo"), family["bounds"]["exp2"]["tau_s"]["outer"][0]);
    EXPECT_EQ(points.Number(row, "inner_hi"), family["bounds"]["exp2"]["tau_s"]["inner"][1]);
    ++compared;
  }
  EXPECT_EQ(compared, 1U);
}

TEST_F(Campaign, AGridHasAllCombinations) {
  const ProgramResult result =
      Run("commands: [fit]\nconfig: rig.yaml\n"
          "grid:\n  model.modes: [1, 2]\n  experiments.exp1.gain: {from: 12, to: 13, step: 0.5}\n"
          "  experiments[1].phi: [0.6]\n",
          "grid");
  EXPECT_EQ(result.status, 0) << result.err;
  const CsvTable table = Table("grid");
  EXPECT_THAT(Column(table, "rig"),
              ElementsAre("rig-1", "rig-2", "rig-3", "rig-4", "rig-5", "rig-6"));
  EXPECT_THAT(Column(table, "model.modes"), ElementsAre("1", "1", "1", "2", "2", "2"));
  EXPECT_THAT(Column(table, "experiments.exp1.gain"),
              ElementsAre("12", "12.5", "13", "12", "12.5", "13"));
  // The values were those of the fits.
  EXPECT_EQ(Json("grid/rigs/rig-3/solution.json")["experiments"][0]["gain"], 13.0);
  EXPECT_EQ(Json("grid/rigs/rig-3/solution.json")["experiments"][1]["gain"], 11.0);
}

TEST_F(Campaign, ATableOfRigsNamesTheirRecords) {
  const std::string simulate = "simulate " + config_.string() + " --out ";
  fs::create_directory(folder_.path() / "measured");
  for (const char* const rig : {"a", "b"}) {
    const std::string seed = rig[0] == 'a' ? " --seed 1" : " --seed 2";
    ASSERT_EQ(RunHowl(simulate + Path(std::string("measured/") + rig) + seed).status, 0);
  }
  folder_.Write("measured/fleet.csv",
                "rig,experiments.exp1.record.file,experiments.exp2.record.file\n"
                "burner_a,a/exp1.csv,a/exp2.csv\nburner_b,b/exp1.csv,\n");
  fs::copy_file(Path("measured/a/records.yaml"), Path("measured/a/template.yaml"));
  const ProgramResult result =
      Run("commands: [analyse]\nconfig: measured/a/template.yaml\nfleet: measured/fleet.csv\n",
          "fleet");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(Column(Table("fleet"), "rig"), ElementsAre("burner_a", "burner_b"));
  EXPECT_THAT(Column(Table("fleet"), "limit_cycles"), ElementsAre("2", "2"));
  const auto frequency = [&](const char* rig, std::size_t experiment) {
    return Json("fleet/rigs/" + std::string(rig) +
                "/analysis.json")["experiments"][experiment]["cycle"]["frequency"]["value"];
  };
  // An empty cell leaves the template's record.
  EXPECT_NE(frequency("burner_a", 0), frequency("burner_b", 0));
  EXPECT_EQ(frequency("burner_a", 1), frequency("burner_b", 1));
}

TEST_F(Campaign, ShardsJoinToTheBytesOfOneMachine) {
  const std::string text =
      "commands: [simulate, analyse]\nconfig: rig.yaml\nkeep: rows\n"
      "grid: {simulate.duration_s: [0.5], seed: {from: 1, to: 5}}\n";
  ASSERT_EQ(Run(text, "whole").status, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "whole/rigs/rig-1"));
  for (const int shard : {2, 3}) {
    ASSERT_EQ(Run(text, "parts", " --shard " + std::to_string(shard) + "/3").status, 0);
  }
  // Those that are there make a table; what is missing is named.
  const ProgramResult part = RunHowl("merge " + Path("parts"));
  EXPECT_EQ(part.status, 1);
  EXPECT_THAT(part.err, HasSubstr("1 of 3 shards of campaign are missing: 1"));
  EXPECT_THAT(part.out, HasSubstr("not run, or changed since: rig-1, rig-4\n"));
  EXPECT_THAT(Column(Table("parts"), "rig"), ElementsAre("rig-2", "rig-3", "rig-5"));
  ASSERT_EQ(Run(text, "parts", " --shard 1/3").status, 0);
  EXPECT_EQ(RunHowl("merge " + Path("parts")).status, 0);
  for (const char* const file : {"campaign.csv", "campaign_points.csv", "campaign.json"}) {
    EXPECT_EQ(ReadFile(folder_.path() / "parts" / file), ReadFile(folder_.path() / "whole" / file))
        << file;
  }
}

TEST_F(Campaign, RunsOnlyWhatIsNew) {
  ASSERT_EQ(Run("commands: [fit]\nconfig: rig.yaml\ngrid: {model.modes: [1]}\n", "grown").status,
            0);
  const auto before = fs::last_write_time(folder_.path() / "grown/rigs/rig-1/solution.json");
  const ProgramResult more =
      Run("commands: [fit]\nconfig: rig.yaml\ngrid: {model.modes: [1, 2]}\n", "grown");
  EXPECT_EQ(more.status, 0) << more.err;
  EXPECT_THAT(more.err, HasSubstr("1 of 2 rigs are done"));
  EXPECT_EQ(fs::last_write_time(folder_.path() / "grown/rigs/rig-1/solution.json"), before);
  // A changed config is named, and is run again.
  folder_.Write("rig.yaml", std::string(kTable) + "title: changed\n");
  const ProgramResult table =
      Run("commands: [fit]\nconfig: rig.yaml\ngrid: {model.modes: [1, 2]}\n", "grown", " --table");
  EXPECT_EQ(table.status, 1);
  EXPECT_THAT(table.out, HasSubstr("not run, or changed since: rig-1, rig-2"));
  const ProgramResult again =
      Run("commands: [fit]\nconfig: rig.yaml\ngrid: {model.modes: [1, 2]}\n", "grown");
  EXPECT_EQ(again.err.find("are done"), std::string::npos) << again.err;
  EXPECT_NE(fs::last_write_time(folder_.path() / "grown/rigs/rig-1/solution.json"), before);
}

TEST_F(Campaign, ARigWithAnErrorHasItInItsRow) {
  folder_.Write("absent.yaml",
                "experiments:\n  - {name: exp1, phi: 0.5, record: {file: no.csv}}\n");
  const ProgramResult result = Run("commands: [fit]\nconfigs: [rig.yaml, absent.yaml]\n", "some");
  EXPECT_EQ(result.status, 1);
  const CsvTable table = Table("some");
  EXPECT_EQ(table.Text(0, "error"), "");
  EXPECT_THAT(table.Text(1, "error"), HasSubstr("there is no file"));
  EXPECT_EQ(table.Text(1, "fit_status"), "2");
}

TEST_F(Campaign, MistakesAreNamedBeforeAnythingIsRun) {
  folder_.Write("twice.csv", "rig,model.modes\na,1\na,2\n");
  folder_.Write("nameless.csv", "name,model.modes\na,1\n");
  const std::pair<const char*, const char*> mistakes[] = {
      {"commands: [fit]\n", "configs: is missing"},
      {"configs: [rig.yaml]\nconfig: rig.yaml\n", "config: stands beside configs"},
      {"configs: [none*.yaml]\n", "there is no file"},
      {"configs: [rig.yaml]\ncommands: [fit, fit]\n", "stands twice"},
      {"configs: [rig.yaml]\ncommands: [fly]\n", "campaign.yaml:2: commands"},
      {"configs: [rig.yaml]\noptions: {diagnose: --plan}\n", "is not among the commands"},
      {"config: rig.yaml\ngrid: {experiments.exp9.gain: [1]}\n", "leads nowhere from \"exp9\""},
      {"config: rig.yaml\ngrid: {model.modos: [1]}\n", "model.modos: is not a known key"},
      {"config: rig.yaml\ngrid: {model.modes: 1}\n", "expected a list of values"},
      {"config: rig.yaml\ngrid: {seed: {from: 3, to: 1}}\n", "has no values"},
      {"config: rig.yaml\ngrid: {seed: [x]}\n", "expected a whole number"},
      {"config: rig.yaml\nfleet: none.csv\n", "no such file"},
      {"config: rig.yaml\nfleet: nameless.csv\n", "rig: is no column"},
      {"config: rig.yaml\nfleet: twice.csv\n", "is the name of two rigs"},
      {"- rig.yaml\n", "is no campaign"},
      {"configs: [rig.yaml]\nfleets: x.csv\n", "the nearest one, fleet"}};
  for (const auto& [text, message] : mistakes) {
    const ProgramResult result = Run(text, "none");
    EXPECT_EQ(result.status, 2) << text;
    EXPECT_THAT(result.err, HasSubstr(message)) << text;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(folder_.path() / "none/campaign.csv")) << text;
  }
}

TEST_F(Campaign, TheReportHasASection) {
  ASSERT_EQ(Run("config: rig.yaml\ngrid: {model.modes: [1]}\n", "page").status, 0);
  const ProgramResult result = RunHowl("report " + Path("page"));
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string page = ReadFile(folder_.path() / "page/report.html");
  EXPECT_THAT(page, HasSubstr("All rigs"));
  EXPECT_THAT(page, HasSubstr("1 of 1 rigs, 0 with an error"));
  EXPECT_THAT(page, HasSubstr("figure-campaign_quantities"));
}

}  // namespace
}  // namespace howl::campaign_test
