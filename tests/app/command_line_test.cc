// The command line: flags, the files and the environment that they come from, help, mistakes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "estimation/residual_spec.h"
#include "io/config/schema/config_schema.h"
#include "model/effects/catalogue.h"
#include "tests/app/program.h"

namespace howl::command_line_test {
namespace {

using testing::HasSubstr;
using testing::Not;

// A fit of one start: what a flag does shows in run.json, or in the folder that it writes to.
class Flags : public testing::Test {
 protected:
  ProgramResult Fit(const std::string& arguments, const std::string& before = "") const {
    return RunHowl(before + "fit " + config_ + " " + arguments);
  }
  std::string Folder(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string RunFile(const std::string& name) const {
    return ReadFile(folder_.path() / name / "run.json");
  }

  const TemporaryFolder folder_;
  const std::string config_ =
      folder_
          .Write("one.yaml",
                 "experiments:\n"
                 "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
                 "solver: {starts: 1}\n")
          .string();
};

TEST_F(Flags, AllWaysToWriteOneMeanTheSame) {
  int next = 0;
  for (const std::string form :
       {"--seed 77 --quiet", "--seed=77 --quiet", "-seed 77 -quiet", "--seed=77 --quiet=true",
        "--seed 3 --noquiet --seed 77 --quiet"}) {
    const std::string name = "out" + std::to_string(next++);
    const ProgramResult run = Fit(form + " --out " + Folder(name));
    EXPECT_EQ(run.status, 0) << form << run.err;
    EXPECT_EQ(run.out + run.err, "") << form;
    EXPECT_THAT(RunFile(name), HasSubstr("77")) << form;
  }
  // Before the command, too.
  EXPECT_EQ(Fit("--out " + Folder("before"), "--seed 77 --quiet ").status, 0);
  EXPECT_THAT(RunFile("before"), HasSubstr("77"));
  // A dash or an underscore.
  const std::string rest = config_ + " --out " + Folder("dashes") + " --quiet";
  EXPECT_EQ(RunHowl("family --save_every 5 " + rest).status, 0);
  EXPECT_EQ(RunHowl("family -save-every=5 " + rest).status, 0);
}

TEST_F(Flags, FromAFile) {
  const std::string flags = folder_
                                .Write("night.flags", "# for the night\n\n--seed=78\n  --out " +
                                                          Folder("night") + "  \n--quiet\n")
                                .string();
  const ProgramResult run = Fit("--flagfile " + flags);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out + run.err, "");
  EXPECT_THAT(RunFile("night"), HasSubstr("78"));
  // The later one holds, and a file may name another.
  const std::string both = folder_.Write("both.flags", "--flagfile=" + flags + "\n").string();
  EXPECT_EQ(Fit("--flagfile=" + both + " --seed 79").status, 0);
  EXPECT_THAT(RunFile("night"), HasSubstr("79"));
  EXPECT_EQ(Fit("--seed 80 --flagfile=" + both).status, 0);
  EXPECT_THAT(RunFile("night"), HasSubstr("78"));
}

TEST_F(Flags, AFileSharedByCommandsHasFlagsThatSomeLack) {
  const std::string flags =
      folder_.Write("shared.flags", "--undefok=save-every,sort\n--save-every=5\n--seed=81\n")
          .string();
  for (const std::string command : {"fit ", "family "}) {
    const ProgramResult run =
        RunHowl(command + config_ + " --quiet --flagfile=" + flags + " --out " + Folder("shared"));
    EXPECT_EQ(run.status, 0) << command << run.err;
    EXPECT_THAT(RunFile("shared"), HasSubstr("81")) << command;
  }
}

TEST_F(Flags, MistakesInAFileAreNamedByItsLine) {
  for (const auto& [text, line, expected] : std::vector<std::tuple<std::string, int, std::string>>{
           {"--seed=1\n\n--thread=2\n", 3,
            "--thread: no such option of howl fit, expected the "
            "nearest one, --threads"},
           {"seed=1\n", 1, "seed=1: expected --name=value"},
           {"--seed=many\n", 1, "--seed: many, expected a whole number from 0 to 2^64 - 1"},
           {"--seed\n", 1, "--seed: expected S after it"},
           {"--sort=x\n", 1, "--sort: no option of howl fit, but one of howl list"},
           {"--flagfile=nowhere.flags\n", 1, "--flagfile: nowhere.flags: not readable"}}) {
    const std::string flags = folder_.Write("bad.flags", text).string();
    const ProgramResult run = Fit("--flagfile=" + flags + " --out " + Folder("bad"));
    EXPECT_EQ(run.status, 2) << text;
    EXPECT_THAT(run.err, testing::StartsWith(flags + ":" + std::to_string(line) + ": " + expected));
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(Folder("bad"))) << text;
  }
  const std::string loop = Folder("loop.flags");
  folder_.Write("loop.flags", "--flagfile=" + loop + "\n");
  const ProgramResult run = Fit("--flagfile=" + loop);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("names itself"));
}

TEST_F(Flags, FromTheEnvironment) {
  ASSERT_EQ(setenv("FLAGS_seed", "8675309", 1), 0);
  const std::string out = " --quiet --out " + Folder("environment");
  EXPECT_EQ(Fit("--fromenv=seed" + out).status, 0);
  EXPECT_THAT(RunFile("environment"), HasSubstr("8675309"));
  EXPECT_EQ(Fit("--tryfromenv=seed,threads" + out).status, 0);
  EXPECT_THAT(RunFile("environment"), HasSubstr("8675309"));
  // Asked for only.
  EXPECT_EQ(Fit(out).status, 0);
  EXPECT_THAT(RunFile("environment"), Not(HasSubstr("8675309")));
  const ProgramResult absent = Fit("--fromenv=seed,threads" + out);
  EXPECT_EQ(absent.status, 2);
  EXPECT_THAT(absent.err, HasSubstr("FLAGS_threads is not in the environment"));
  ASSERT_EQ(setenv("FLAGS_seed", "many", 1), 0);
  const ProgramResult bad = Fit("--fromenv=seed" + out);
  ASSERT_EQ(unsetenv("FLAGS_seed"), 0);
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("--seed: many, expected"));
}

TEST_F(Flags, VSaysWhatASolverDoes) {
  const std::string out = " --out " + Folder("verbose");
  EXPECT_EQ(Fit(out).err, "");
  const std::string one = Fit("--v=1" + out).err;
  EXPECT_THAT(one, HasSubstr("joint fit: "));
  EXPECT_THAT(one, HasSubstr("1 of 1 starts"));
  EXPECT_THAT(one, Not(HasSubstr("start 0: cost")));
  EXPECT_THAT(Fit("--vmodule=joint_fit=2" + out).err, HasSubstr("start 0: cost"));
  // The answer is the same.
  EXPECT_EQ(Fit("--v=2" + out).out, Fit(out).out);
  const ProgramResult family =
      RunHowl("family " + config_ + " --quiet --vmodule=bound_step=2" + out);
  EXPECT_THAT(family.err, HasSubstr("highest a.omega_hz: a member at "));
}

TEST(CommandLine, TheNearestIsNamed) {
  const std::string config = Config("r228");
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {"ft " + config, "howl: ft: no such command, did you mean fit?"},
           {"familly " + config, "did you mean family?"},
           {"help simulat", "did you mean simulate?"},
           {"nonsense", "expected one that howl --help lists"},
           {"fit " + config + " --ou x",
            "--ou: no such option of howl fit, expected the nearest "
            "one, --out"},
           {"fit " + config + " --thread=2", "expected the nearest one, --threads"},
           {"family " + config + " --save_evry 3", "expected the nearest one, --save-every"},
           {"fit " + config + " --nonsense 3", "expected one that howl fit --help lists"},
           // Another command's.
           {"fit " + config + " --advise",
            "--advise: no option of howl fit, but one of howl family"},
           {"fit " + config + " --filter=x", "but one of howl list"},
           {"--advise fit " + config, "expected after the command"},
           // What gflags and glog have beside: no part of howl.
           {"fit " + config + " --logbufsecs 3", "no such option of howl fit"},
           {"fit " + config + " --helpxml", "no such option of howl fit"}}) {
    const ProgramResult run = RunHowl(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(expected)) << arguments;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "") << arguments;
  }
}

TEST(CommandLine, HelpByCommand) {
  for (const std::string command :
       {"analyse", "diagnose", "fit", "family", "list", "simulate", "regress", "report", "trial"}) {
    const ProgramResult by_flag = RunHowl(command + " --help");
    EXPECT_EQ(by_flag.status, 0) << by_flag.err;
    EXPECT_THAT(by_flag.out, testing::StartsWith("howl " + command + " CONFIG [options]: "));
    for (const std::string& same :
         std::vector<std::string>{"help " + command, command + " -h", command + " -help",
                                  "--help " + command, command + " nowhere.yaml --help"}) {
      EXPECT_EQ(RunHowl(same).out, by_flag.out) << same;
    }
  }
  EXPECT_EQ(RunHowl("help").out, RunHowl("--help").out);
  EXPECT_EQ(RunHowl("").out, RunHowl("-h").out);
  EXPECT_EQ(RunHowl("help nonsense").status, 2);
}

// The schema for editors is that by which a config is read, with all residuals.
TEST(CommandLine, HelpOnResidualsAndOnTheSchemaIsThatOfTheRegistry) {
  const nlohmann::json schema = nlohmann::json::parse(RunHowl("help schema").out);
  EXPECT_EQ(schema, ConfigSchema());
  const std::string help = RunHowl("help residuals").out;
  for (const ResidualKind kind : kResidualKinds) {
    const std::string name(ResidualName(kind));
    EXPECT_TRUE(schema["properties"]["residuals"]["properties"].contains(name)) << name;
    EXPECT_THAT(help, HasSubstr(name + ": "));
  }
  std::string shown;  // as an example of the page
  for (const char c : help) shown += c == '\n' ? std::string("\n    ") : std::string(1, c);
  EXPECT_THAT(ReadFile(std::filesystem::path(HOWL_SOURCE_DIR) / "docs/config.md"),
              HasSubstr("help residuals\n    " + shown.substr(0, shown.size() - 5)));
}

// Whatever joins the catalogue is told, with its block and every parameter.
TEST(CommandLine, HelpOnEffectsIsThatOfTheCatalogue) {
  const std::string help = RunHowl("help effects").out;
  for (const EffectPointer& effect : Catalogue()) {
    EXPECT_THAT(help, HasSubstr(std::string(effect->id()) + ": " +
                                std::string(LoopBlockName(effect->block())) + "\n"));
    for (const EffectParameter& parameter : effect->parameters()) {
      EXPECT_THAT(help, HasSubstr(parameter.name + " (null "));
    }
  }
  EXPECT_THAT(help, HasSubstr("\nflame_lowpass: flame\n    cutoff_hz (null inf; 60 .. 1e+06)\n"));
  EXPECT_THAT(help, HasSubstr("\n    side after_flame: sigma_s (null 0; 1e-06 .. 0.002)\n"));
}

TEST(CommandLine, Version) {
  for (const std::string arguments : {"--version", "fit --version", "-version"}) {
    const ProgramResult run = RunHowl(arguments);
    EXPECT_EQ(run.status, 0);
    EXPECT_TRUE(std::regex_match(run.out, std::regex("howl [0-9]+\\.[0-9]+\\.[0-9]+\n")))
        << run.out;
  }
}

TEST(CommandLine, MistakesAreOneLineAndStatusTwo) {
  const std::string config = Config("r228");
  for (const std::string& arguments : std::vector<std::string>{
           "nonsense", "fit", "fit " + config + " --threads 0", "fit " + config + " --threads",
           "fit " + config + " --seed -3", "fit " + config + " --nonsense",
           "fit " + config + " " + config, "fit /nowhere/a.yaml",
           "fit " + config + " --out /proc/nowhere", "fit " + config + " --quiet=3"}) {
    const ProgramResult run = RunHowl(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << arguments;
  }
}

TEST(CommandLine, HelpExplainsEveryCommand) {
  const ProgramResult help = RunHowl("--help");
  EXPECT_EQ(help.status, 0);
  for (const std::string command : {"fit", "family", "list", "regress"}) {
    EXPECT_THAT(help.out, testing::HasSubstr("  " + command + " "));
    const ProgramResult own = RunHowl(command + " --help");
    EXPECT_EQ(own.status, 0);
    EXPECT_THAT(own.out, testing::HasSubstr("howl " + command + " CONFIG"));
    EXPECT_THAT(own.out, testing::HasSubstr("--threads"));
  }
}

TEST(CommandLine, QuietPrintsNothing) {
  const TemporaryFolder folder;
  for (const std::string command : {"fit ", "family "}) {
    const ProgramResult run =
        RunHowl(command + Config("r228_reliable") + " --quiet --out " + folder.path().string());
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out + run.err, "");
  }
}

}  // namespace
}  // namespace howl::command_line_test
