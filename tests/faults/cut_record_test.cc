// A record that is cut short, or grows, while it is read: its analysis, or one line; never that of
// a part of it.
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "tests/faults/faults.h"

namespace howl::cut_record_test {
namespace {

using testing::HasSubstr;

constexpr int kRows = 400'000;

class CutRecord : public Faults {
 protected:
  void SetUp() override {
    std::string text = "p,q\n";
    for (int i = 0; i < kRows; ++i) {
      char line[64];
      std::snprintf(line, sizeof line, "%.9f,%.9f\n", std::sin(0.27 * i), std::cos(0.27 * i));
      text += line;
    }
    record_ = folder_.Write("r.csv", text);
    bytes_ = text.size();
    config_ = folder_
                  .Write("c.yaml",
                         "experiments: [{name: e1, phi: 0.5, record: {file: r.csv, pressure: p, "
                         "heat_release: q, sampling_hz: 5000, duration_s: 2}}]\n")
                  .string();
  }

  std::filesystem::path record_;
  std::size_t bytes_ = 0;
};

// The reader stands in the middle of a pipe's bytes when the writer ends.
TEST_F(CutRecord, APipeThatEndsInARow) {
  const std::string pipe = Path("pipe").string();
  folder_.Write("c.yaml",
                "experiments: [{name: e1, phi: 0.5, record: {file: pipe, pressure: p, "
                "heat_release: q, sampling_hz: 5000}}]\n");
  for (const int bytes : {1'000, 300'001, 1'000'007}) {
    const ProgramResult run = RunShell("mkfifo " + pipe + "; (head -c " + std::to_string(bytes) +
                                       " " + record_.string() + " > " + pipe + ") & " +
                                       Howl("analyse", "out") + "; s=$?; rm " + pipe + "; exit $s");
    // A part of a row has too few columns or a number that is cut, unless the cut is a row's end.
    if (run.status != 0) ExpectOneLine(run, pipe + ":");
  }
}

TEST_F(CutRecord, AFileThatChangesWhileItIsRead) {
  // At moments from the first byte to behind the last.
  int noticed = 0;
  for (int milliseconds = 0; milliseconds < 60; milliseconds += 3) {
    const pid_t child = StartHowl(Arguments("analyse", "out") + " 2>" + Path("err").string());
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    ASSERT_EQ(truncate(record_.c_str(), static_cast<off_t>(bytes_ / 2)), 0);
    const int status = WaitForEnd(child);
    if (status != 0) {
      ++noticed;
      ExpectOneLine({status, "", ReadFile(Path("err"))}, record_.string());
    }
    SetUp();
  }
  EXPECT_GT(noticed, 0);
}

}  // namespace
}  // namespace howl::cut_record_test
