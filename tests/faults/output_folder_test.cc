// Output folders that cannot be written, that vanish, that two runs want, and disks that are full:
// one line, nothing half-written, and nothing lost once the fault is gone.
#include <signal.h>
#include <unistd.h>

#include "tests/faults/faults.h"

namespace howl::output_folder_test {
namespace {

namespace fs = std::filesystem;

class OutputFolder : public Faults {
 protected:
  // Starts a search for bounds that lasts for minutes, and waits until it has saved some.
  pid_t StartLong(const std::string& out) {
    const pid_t child =
        StartHowl("family " + Config("r228_two_modes") +
                  " --quiet --threads 1 --save-every 0.01 --out " + Path(out).string());
    EXPECT_TRUE(WaitUntil([&] { return fs::exists(Path(out) / "bounds.state"); }));
    return child;
  }
  // A run that stands still has its folder for as long as the test needs.
  static void Stop(pid_t child) { EXPECT_EQ(kill(-child, SIGSTOP), 0); }
  static void Kill(pid_t child) {
    EXPECT_EQ(kill(-child, SIGKILL), 0);
    EXPECT_EQ(WaitForEnd(child), 128 + SIGKILL);
  }
};

TEST_F(OutputFolder, TwoRunsDoNotShareOne) {
  const pid_t child = StartLong("out");
  Stop(child);
  ExpectOneLine(RunShell(Howl("fit", "out")),
                Path("out").string() + ": another run is writing here (howl family, process " +
                    std::to_string(child) + "), expected its end, or another --out");
  EXPECT_FALSE(fs::exists(Path("out") / "solution.json"));
  // The lock of a run that was killed holds nobody up, and nothing that it left stays.
  Kill(child);
  std::ofstream(Path("out") / ".solution.json.howl-abc123") << "half a file";
  const ProgramResult next = RunShell(Howl("fit", "out"));
  EXPECT_EQ(next.status, 0) << next.err;
  EXPECT_TRUE(fs::exists(Path("out") / "solution.json"));
  EXPECT_FALSE(fs::exists(Path("out") / ".howl.lock"));
  EXPECT_FALSE(fs::exists(Path("out") / ".solution.json.howl-abc123"));
}

TEST_F(OutputFolder, ShardsShareOneAndAMergeWaitsForThem) {
  const std::string command = "family " + Config("r228_two_modes") +
                              " --quiet --threads 1 --save-every 0.01 --out " +
                              Path("out").string() + " --shard ";
  const pid_t first = StartHowl(command + "1/2");
  EXPECT_TRUE(WaitUntil([&] { return fs::exists(Path("out") / "shards/1-of-2.family.part"); }));
  Stop(first);
  const pid_t second = StartHowl(command + "2/2");
  EXPECT_TRUE(WaitUntil([&] { return fs::exists(Path("out") / "shards/2-of-2.family.part"); }));
  Stop(second);
  ExpectOneLine(RunShell(std::string(HOWL_PROGRAM) + " " + command + "1/2"),
                "another run is writing here (howl family --shard 1-of-2, process");
  ExpectOneLine(RunShell(std::string(HOWL_PROGRAM) + " merge " + Path("out").string()),
                "another run is writing here");
  Kill(first);
  Kill(second);
}

TEST_F(OutputFolder, CtrlCLeavesNoLock) {
  const pid_t child = StartLong("out");
  EXPECT_EQ(kill(child, SIGINT), 0);
  EXPECT_EQ(WaitForEnd(child), 130);
  EXPECT_FALSE(fs::exists(Path("out") / ".howl.lock"));
  EXPECT_TRUE(fs::exists(Path("out") / "bounds.state"));
  // A command that saves nothing on its way says that it was interrupted, too. Whatever its moment
  // is, it ends so or is done.
  for (const char* const seconds : {"0.01", "0.03", "0.05"}) {
    const ProgramResult fit = RunShell("timeout -s INT " + std::string(seconds) + " " +
                                       Howl("simulate", "fit", "") + "; echo $? >&2");
    EXPECT_FALSE(fs::exists(Path("fit") / ".howl.lock")) << fit.err;
  }
}

TEST_F(OutputFolder, ThatCannotBeWrittenIsNamedBeforeTheWork) {
  ExpectOneLine(RunShell(Howl("fit", "rig.yaml/out")), "rig.yaml/out: cannot make this folder: ");
  // Root may write everywhere.
  std::string as_user;
  if (geteuid() == 0) as_user = "setpriv --reuid=65534 --regid=65534 --clear-groups ";
  fs::permissions(folder_.path(), fs::perms::owner_all | fs::perms::others_read |
                                      fs::perms::others_exec | fs::perms::group_read |
                                      fs::perms::group_exec);
  if (RunShell(as_user + HOWL_PROGRAM + " --version").status != 0) {
    GTEST_SKIP() << "the program cannot be run as another user here";
  }
  fs::create_directory(Path("closed"));
  fs::permissions(Path("closed"), fs::perms::others_read | fs::perms::others_exec |
                                      fs::perms::owner_read | fs::perms::owner_exec);
  for (const char* const command : {"fit", "family", "simulate", "campaign", "trial"}) {
    const ProgramResult run = RunShell(as_user + Howl(command, "closed"));
    ExpectOneLine(run, "closed: cannot be written: Permission denied");
    EXPECT_TRUE(fs::is_empty(Path("closed")));
  }
}

TEST_F(OutputFolder, ThatVanishesIsMadeAgain) {
  ASSERT_EQ(RunShell(Howl("simulate", "records")).status, 0);
  config_ = (Path("records") / "records.yaml").string();
  ASSERT_EQ(RunShell(Howl("diagnose", "peace")).status, 0);
  const pid_t child = StartHowl(Arguments("diagnose", "out"));
  EXPECT_TRUE(WaitUntil([&] { return fs::exists(Path("out") / "diagnosis.state"); }));
  fs::remove_all(Path("out"));
  EXPECT_EQ(WaitForEnd(child), 0);
  EXPECT_EQ(ReadFile(Path("out") / "diagnosis.json"), ReadFile(Path("peace") / "diagnosis.json"));
}

}  // namespace
}  // namespace howl::output_folder_test
