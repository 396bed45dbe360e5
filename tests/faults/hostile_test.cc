// Configs and results that someone made to do harm: nothing is run, nothing is written outside of
// --out, and nothing of the environment is told but what the config names.
#include <nlohmann/json.hpp>

#include "tests/faults/faults.h"

namespace howl::hostile_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

constexpr const char* kSecret = "HOWL_SECRET=value_of_the_secret ";

class Hostile : public Faults {
 protected:
  // The small problem with a first experiment of this name and a title that has it too.
  void WriteNamed(const std::string& name) {
    Json config = {
        {"title", "${HOWL_SECRET}"},
        {"experiments",
         {{{"name", name}, {"phi", 0.56}, {"frequency_hz", 212}, {"phase_deg", -8}, {"gain", 12}},
          {{"name", "e2"},
           {"phi", 0.60},
           {"frequency_hz", 214},
           {"phase_deg", -10},
           {"gain", 11}}}},
        {"simulate", {{"duration_s", 0.5}, {"sampling_hz", 5000}}},
        {"family", {{"members", 3}, {"width", 0.3}}}};
    folder_.Write("rig.yaml", config.dump());  // JSON is YAML
  }
  // What is in the folder beside the config and the output.
  std::size_t Others(const std::string& out) const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      count += name != out && name != "rig.yaml" ? 1 : 0;
    }
    return count;
  }
};

TEST_F(Hostile, NamesThatArePathsOrMarkupAreRefused) {
  for (const char* const name :
       {"a/b", "../up", "/abs", "it's", "say \"a\"", "two\nlines", "<script>x</script>", "a,b",
        "{/Symbol a}", ".hidden", "a\\b", "system('touch ran')", "a${HOWL_SECRET}", "tab\there",
        "esc\x1b[2J"}) {
    WriteNamed(name);
    const ProgramResult run = RunShell(kSecret + Howl("simulate", "out"));
    EXPECT_EQ(run.status, 2) << name;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("experiments[0].name: "));
    EXPECT_THAT(run.err, Not(HasSubstr("value_of_the_secret")));
    EXPECT_EQ(Others("out"), 0U) << name;
    EXPECT_FALSE(fs::exists(Path("out"))) << name;
  }
}

// All that a name may have goes through the commands, gnuplot and the page.
TEST_F(Hostile, NamesThatAreAllowedDoNothing) {
  WriteNamed("%s%n%d");
  Json config = Json::parse(ReadFile(Path("rig.yaml")));
  for (const char* const name : {"`touch ran`", "$(touch ran)", "@{x}^2_{y}", "-x", "]]>", "#c",
                                 "a&b;c", "*", "\u202eabc"}) {
    config["experiments"].push_back(config["experiments"][0]);
    config["experiments"].back()["name"] = name;
  }
  const std::string at = "cd " + folder_.path().string() + "; " + kSecret;
  for (const char* const command : {"family", "fit", "simulate"}) {
    const ProgramResult run = RunShell(at + Howl(command, "out"));
    EXPECT_EQ(run.status, 0) << run.err;
    folder_.Write("rig.yaml", config.dump());  // the family is of two experiments, to be quick
  }
  const ProgramResult report = RunShell(at + HOWL_PROGRAM + " report " + Path("out").string());
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_THAT(report.out, Not(HasSubstr("could not draw")));
  EXPECT_EQ(Others("out"), 0U);
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(Path("out"))) {
    if (entry.is_regular_file()) all += ReadFile(entry.path());
  }
  EXPECT_THAT(all, HasSubstr("touch ran"));
  EXPECT_THAT(all, Not(HasSubstr("value_of_the_secret")));
}

TEST_F(Hostile, ResultsAreTextOnThePage) {
  WriteNamed("e1");
  for (const char* const command : {"fit", "simulate"}) {
    ASSERT_EQ(RunShell(Howl(command, "out")).status, 0);
  }
  const std::string evil = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'";
  Json solution = Json::parse(ReadFile(Path("out") / "solution.json"));
  solution["experiments"][0]["name"] = evil;
  solution["termination"] = evil;
  folder_.Write("out/solution.json", solution.dump());
  Json run = Json::parse(ReadFile(Path("out") / "run.json"));
  run["config_text"] = "title: \"" + evil.substr(0, evil.size() - 2) + "\"\n" +
                       run["config_text"].get<std::string>();
  run["config"] = "/gone/" + evil;
  run["commands"][evil] = {{"seed", 1}, {"version", evil}};
  folder_.Write("out/run.json", run.dump());
  ASSERT_EQ(RunShell(std::string(HOWL_PROGRAM) + " report " + Path("out").string()).status, 0);
  const std::string page = ReadFile(Path("out") / "report.html");
  EXPECT_THAT(page, HasSubstr("alert(1)"));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
}

TEST_F(Hostile, AVariableOfTheEnvironmentIsReadWhereTheConfigNamesAFileAlone) {
  folder_.Write(
      "rig.yaml",
      "title: \"${HOWL_SECRET}\"\n"
      "experiments: [{name: e1, phi: 0.5, record: {file: \"${HOWL_SECRET}/r.csv\", pressure: "
      "\"${HOWL_SECRET}\", sampling_hz: 5000}}]\n");
  const ProgramResult run = RunShell(kSecret + Howl("analyse", "out"));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("there is no file \"${HOWL_SECRET}/r.csv\""));
  EXPECT_THAT(run.err, Not(HasSubstr("value_of_the_secret")));
}

}  // namespace
}  // namespace howl::hostile_test
