// Standard streams that are closed, full, or read by nobody.
#include "tests/faults/faults.h"

namespace howl::streams_test {
namespace {

class Streams : public Faults {
 protected:
  std::string Fit(const std::string& out) const {
    return std::string(HOWL_PROGRAM) + " fit " + config_ + " --out " + Path(out).string();
  }
  void SetUp() override { ASSERT_EQ(RunShell(Fit("peace")).status, 0); }
  // What was printed did not go into a file.
  void ExpectWholeResults(const std::string& out) const {
    EXPECT_EQ(ReadFile(Path(out) / "solution.json"), ReadFile(Path("peace") / "solution.json"));
    EXPECT_EQ(ReadFile(Path(out) / "run.json"), ReadFile(Path("peace") / "run.json"));
  }
};

TEST_F(Streams, Closed) {
  ExpectOneLine(RunShell(Fit("out") + " >&-"), "standard output: cannot be written: ");
  ExpectWholeResults("out");
  const ProgramResult all = RunShell(Fit("none") + " <&- >&- 2>&-");
  EXPECT_EQ(all.status, 2);
  ExpectWholeResults("none");
  EXPECT_EQ(RunShell(Fit("input") + " <&-").status, 0);
  ExpectWholeResults("input");
}

TEST_F(Streams, FullDevice) {
  ExpectOneLine(RunShell(Fit("out") + " >/dev/full"),
                "standard output: cannot be written: No space left on device");
  ExpectWholeResults("out");
}

// As of any program whose output goes to head: no complaint, and what it has begun is finished.
TEST_F(Streams, AReaderThatHasGone) {
  const ProgramResult run = RunShell("{ sleep 0.3; " + Fit("out") + "; echo $? >" +
                                     Path("status").string() + "; } | true");
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(WaitUntil([&] { return ReadFile(Path("status")) == "141\n"; }));
  ExpectWholeResults("out");
}

}  // namespace
}  // namespace howl::streams_test
