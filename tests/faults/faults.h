// What the tests of faults share: a small problem, and what is asked of a run that a fault ended.
#ifndef HOWL_TESTS_FAULTS_FAULTS_H_
#define HOWL_TESTS_FAULTS_FAULTS_H_

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <string>

#include "tests/app/program.h"

namespace howl {

inline constexpr const char* kTwoPoints =
    "experiments:\n"
    "  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12, flame_slope: "
    "-0.7e-4}\n"
    "  - {name: exp2, phi: 0.60, frequency_hz: 214, phase_deg: -10, gain: 11, flame_slope: "
    "-0.7e-4}\n"
    "simulate: {duration_s: 0.85, sampling_hz: 5000}\n";

// `line` goes through the shell: limits before the program, redirections behind it. The status is
// that of the shell, 128 and more where a signal ended the program.
inline ProgramResult RunShell(const std::string& line) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const std::string err = (folder.path() / "err").string();
  const std::string command = "( " + line + " ) >" + out + " 2>" + err;
  const int raw = std::system(command.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, ReadFile(out), ReadFile(err)};
}

// Status 2 and one line that says what happened.
inline void ExpectOneLine(const ProgramResult& run, const std::string& what) {
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
  EXPECT_THAT(run.err, testing::HasSubstr(what));
}

inline int WaitForEnd(pid_t child) {
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class Faults : public testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }
  // The command on the small problem, with its output in `out`.
  std::string Howl(const std::string& command, const std::string& out,
                   const std::string& options = "") const {
    return std::string(HOWL_PROGRAM) + " " + Arguments(command, out, options);
  }
  std::string Arguments(const std::string& command, const std::string& out,
                        const std::string& options = "") const {
    return command + " " + config_ + " --quiet --threads 1 --out " + Path(out).string() + " " +
           options;
  }

  TemporaryFolder folder_;
  std::string config_ = folder_.Write("rig.yaml", kTwoPoints).string();
};

}  // namespace howl

#endif  // HOWL_TESTS_FAULTS_FAULTS_H_
