// Little memory, few descriptors, another language's numbers: an answer that is right, or one line.
#include "tests/faults/faults.h"

namespace howl::limits_test {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

class Limits : public Faults {
 protected:
  void SetUp() override {
    ASSERT_EQ(RunShell(Howl("simulate", "records")).status, 0);
    folder_.Write("campaign.yaml",
                  "configs: [rig.yaml]\ngrid: {\"experiments[0].gain\": [11, 12]}\n"
                  "commands: [simulate, fit]\n");
  }
  std::string On(const std::string& config, const std::string& command, const std::string& out) {
    config_ = Path(config).string();
    return Howl(command, out, "--threads 2");
  }
};

TEST_F(Limits, FewDescriptors) {
  // What runs the test may have others open, which count.
  const std::string kCloseOthers = "exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&- 9>&-; ";
  int refused = 0;
  for (const int count : {4, 5, 6, 8, 10, 12, 16, 24}) {
    for (const auto& [config, command] : {std::pair("rig.yaml", "fit"),
                                          {"records/records.yaml", "analyse"},
                                          {"campaign.yaml", "campaign"}}) {
      const ProgramResult run = RunShell(kCloseOthers + "ulimit -n " + std::to_string(count) +
                                         "; exec " + On(config, command, "out"));
      if (run.status == 0 || run.status == 127) continue;  // 127: its libraries did not open
      ++refused;
      SCOPED_TRACE(std::string(command) + " with " + std::to_string(count));
      // A campaign has the fault of one rig in that rig's row.
      if (run.status == 1 && std::string(command) == "campaign") {
        EXPECT_THAT(ReadFile(Path("out/campaign.csv")), HasSubstr("Too many open files"));
      } else {
        ExpectOneLine(run, "Too many open files");
      }
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_F(Limits, LittleMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need all of the address space";
#endif
  int refused = 0;
  for (int megabytes = 55; megabytes <= 130; megabytes += 5) {
    // Where the linear algebra is OpenBLAS, each of its threads asks for memory until it is given:
    // the program's end then waits for them for ever.
    const std::string limit = "ulimit -c 0; ulimit -v " + std::to_string(megabytes * 1000) +
                              "; OPENBLAS_NUM_THREADS=1 exec ";
    // Where not even the version is said, the libraries found no room as they were loaded: nothing
    // of the program has run.
    if (RunShell(limit + std::string(HOWL_PROGRAM) + " --version").status != 0) continue;
    for (const auto& [config, command] :
         {std::pair("rig.yaml", "fit"), {"records/records.yaml", "analyse"}}) {
      const ProgramResult run = RunShell(limit + On(config, command, "out"));
      if (run.status == 0) continue;
      ++refused;
      SCOPED_TRACE(std::string(command) + " with " + std::to_string(megabytes) + " MB");
      EXPECT_EQ(run.status, 2);
      EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
      EXPECT_THAT(run.err, AnyOf(HasSubstr("memory"), HasSubstr("no more threads can be started")));
    }
  }
  EXPECT_GT(refused, 0);
}

// More threads than cores are no fault.
TEST_F(Limits, ManyThreads) {
  const ProgramResult run = RunShell(Howl("fit", "out", "--threads 64"));
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
}

TEST_F(Limits, OtherLocales) {
  const auto results = [&](const std::string& environment, const std::string& out) {
    std::string text;
    for (const auto& [config, command] : {std::pair("rig.yaml", "fit"),
                                          {"rig.yaml", "simulate"},
                                          {"records/records.yaml", "analyse"}}) {
      const ProgramResult run = RunShell("env " + environment + " " + On(config, command, out));
      EXPECT_EQ(run.status, 0) << run.err;
      EXPECT_EQ(run.err, "");
    }
    for (const char* const file :
         {"solution.json", "simulation.json", "exp1.csv", "characteristics.csv", "analysis.json"}) {
      text += ReadFile(Path(out) / file);
    }
    return text;
  };
  const std::string expected = results("LC_ALL=C", "c");
  EXPECT_EQ(results("LC_ALL=no_such.locale LANG=garbage", "garbage"), expected);
  // Decimal commas; made here, because few machines have it.
  const std::string german = Path("locales").string();
  fs::create_directory(german);
  if (RunShell("localedef -i de_DE -f UTF-8 " + german + "/de_DE.UTF-8").status != 0) {
    GTEST_SKIP() << "localedef makes no German locale here";
  }
  ASSERT_EQ(RunShell("LOCPATH=" + german + " LC_ALL=de_DE.UTF-8 locale decimal_point").out, ",\n");
  EXPECT_EQ(results("LOCPATH=" + german + " LC_ALL=de_DE.UTF-8", "german"), expected);
}

}  // namespace
}  // namespace howl::limits_test
