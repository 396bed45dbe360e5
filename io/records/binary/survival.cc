#include "io/records/binary/survival.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "io/user_error.h"

namespace howl {
namespace {

constexpr double kLeastSeconds = 10.0;
constexpr double kSlowestBytesPerSecond = 1e6;  // packed ones take longest

rlim_t LongestSeconds(const std::string& file) {
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(file, ignored);
  return static_cast<rlim_t>(kLeastSeconds +
                             (ignored ? 0.0 : static_cast<double>(bytes)) / kSlowestBytesPerSecond);
}

[[noreturn]] void ReadAndEnd(rlim_t seconds, const std::function<void()>& read) {
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) {
    ::signal(signal, SIG_DFL);
  }
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const rlimit processor{seconds, seconds};
  setrlimit(RLIMIT_CPU, &processor);
  // What a library says of its fault is no line of this program's.
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  try {
    read();
  } catch (...) {  // NOLINT(bugprone-empty-catch): the caller meets it again
  }
  _exit(0);
}

}  // namespace

void RequireSurvival(const std::string& file, const std::function<void()>& read) {
  const rlim_t seconds = LongestSeconds(file);
  const pid_t child = fork();
  if (child < 0) {
    throw UserError(file, 0, "", std::string("cannot be read: ") + std::strerror(errno));
  }
  if (child == 0) ReadAndEnd(seconds, read);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw UserError(file, 0, "",
                  "damaged: the library that reads such files fails on it, expected a whole file");
}

}  // namespace howl
