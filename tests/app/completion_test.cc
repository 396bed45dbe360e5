// What the shells offer: `howl help complete WORD...`, the words after the program's name. The
// shells themselves are driven by tests/install/check_completion.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::completion_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using testing::StartsWith;

// The words without their descriptions. `words` go through the shell.
std::vector<std::string> Offered(const std::string& words) {
  const ProgramResult run = RunHowl("help complete " + words);
  EXPECT_EQ(run.status, 0) << words;
  EXPECT_EQ(run.err, "") << words;
  std::vector<std::string> offered;
  std::istringstream lines(run.out);
  for (std::string line; std::getline(lines, line);) {
    offered.push_back(line.substr(0, line.find('\t')));
  }
  return offered;
}

TEST(Completion, OffersCommandsAndWhatHelpExplains) {
  EXPECT_THAT(Offered("f"), ElementsAre("fit", "family"));
  EXPECT_THAT(Offered("''"), AllOf(Contains("report"), Contains("help"), Not(Contains("--out"))));
  EXPECT_THAT(Offered("--seed 3 fam"), ElementsAre("family"));
  EXPECT_THAT(Offered("help m"), ElementsAre("merge", "man"));
  EXPECT_THAT(Offered("help man fi"), ElementsAre("fit"));
  EXPECT_THAT(Offered("help completion ''"), ElementsAre("bash", "zsh", "fish"));
  EXPECT_THAT(Offered("nothing ''"), ElementsAre());
  EXPECT_THAT(Offered(""), Contains("fit"));
}

TEST(Completion, OffersOptionsOfTheCommandThatAreNotGivenYet) {
  EXPECT_THAT(Offered("family --f"), ElementsAre("--falsify", "--flagfile", "--fromenv"));
  EXPECT_THAT(Offered("fit --fa"), ElementsAre());
  EXPECT_THAT(Offered("fit x.yaml --seed 3 --se"), ElementsAre());
  EXPECT_THAT(Offered("fit x.yaml --seed=3 --se"), ElementsAre());
  // Of those that may be given several times, again; and a value is no option.
  EXPECT_THAT(Offered("predict x.yaml --at 0.5 --a"), ElementsAre("--at"));
  EXPECT_THAT(Offered("fit x.yaml --out --seed --se"), ElementsAre("--seed"));
}

TEST(Completion, AsksTheShellForFilesOfTheRightKind) {
  EXPECT_THAT(Offered("fit ''"), ElementsAre(":configs"));
  EXPECT_THAT(Offered("init ''"), ElementsAre(":files"));
  EXPECT_THAT(Offered("init a.csv ''"), ElementsAre(":files"));
  EXPECT_THAT(Offered("merge ''"), ElementsAre(":folders"));
  EXPECT_THAT(Offered("fit --out ''"), ElementsAre(":folders"));
  EXPECT_THAT(Offered("fit --out=''"), ElementsAre(":folders"));
  EXPECT_THAT(Offered("init a.csv --out ''"), ElementsAre(":configs"));
  EXPECT_THAT(Offered("family --falsify ''"), ElementsAre(":configs"));
  EXPECT_THAT(Offered("fit --flagfile ''"), ElementsAre(":files"));
  EXPECT_THAT(Offered("fit --threads ''"), ElementsAre());
}

TEST(Completion, OffersNamesThatTheConfigAndTheCatalogueHave) {
  EXPECT_THAT(Offered("list " + Config("r228") + " --experiment ''"),
              ElementsAre("exp1", "exp2", "exp3", "exp4", "exp5", "exp6"));
  EXPECT_THAT(Offered("family " + Config("r228") + " --profile=exp2.t"), ElementsAre("exp2.tau_s"));
  EXPECT_THAT(Offered("trial --severities small,m"), ElementsAre("small,medium"));
  EXPECT_THAT(Offered("trial --effects catalogue,q_sensor_l"),
              ElementsAre("catalogue,q_sensor_lowpass"));
  EXPECT_THAT(Offered("diagnose --without p_clipping,q_cl"), ElementsAre("p_clipping,q_clipping"));
  EXPECT_THAT(Offered("family --without xi_max,loop_g"), ElementsAre("xi_max,loop_gain_min"));
  EXPECT_THAT(Offered("fit --fromenv threads,se"), ElementsAre("threads,seed"));
}

TEST(Completion, OffersTheColumnsOfAFamilyThatIsListed) {
  const TemporaryFolder folder;
  const std::string config =
      folder
          .Write("two.yaml",
                 "experiments:\n"
                 "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
                 "  - {name: b, phi: 0.53, frequency_hz: 209.1, phase_deg: -9.44, gain: 13.15}\n"
                 "family: {members: 5}\n")
          .string();
  const std::string out = " --out " + (folder.path() / "out").string();
  EXPECT_THAT(Offered("list " + config + out + " --sort om"), ElementsAre());  // not listed yet
  ASSERT_EQ(RunHowl("family " + config + out + " --quiet").status, 0);
  EXPECT_THAT(Offered("list " + config + out + " --sort om"), ElementsAre("omega_spread"));
  EXPECT_THAT(Offered("list " + config + out + " --sort -b.x"), ElementsAre("-b.xi"));
  EXPECT_THAT(Offered("list " + config + out + " --columns member,a.ta"),
              ElementsAre("member,a.tau_s"));
}

TEST(Completion, SaysNothingOfConfigsThatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string broken = folder.Write("broken.yaml", "experiments: [").string();
  EXPECT_THAT(Offered("list " + broken + " --experiment ''"), ElementsAre());
  EXPECT_THAT(Offered("list --experiment ''"), ElementsAre());
  EXPECT_THAT(Offered("list /nowhere.yaml --sort ''"), ElementsAre());
}

TEST(CompletionScript, IsPrintedForThreeShells) {
  for (const char* const shell : {"bash", "zsh", "fish"}) {
    const ProgramResult run = RunHowl(std::string("help completion ") + shell);
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out,
              ReadFile(std::string(HOWL_SOURCE_DIR) + "/app/help/completion/howl." + shell));
  }
  for (const char* const words :
       {"completion tcsh", "completion", "completion bash zsh", "man fits"}) {
    const ProgramResult run = RunHowl(std::string("help ") + words);
    EXPECT_EQ(run.status, 2) << words;
    EXPECT_EQ(run.out, "") << words;
    EXPECT_THAT(run.err, StartsWith("howl: ")) << words;
  }
}

}  // namespace
}  // namespace howl::completion_test
