#include "app/process/standard_streams.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "io/user_error.h"

namespace howl {
namespace {

volatile sig_atomic_t reader_is_gone = 0;

// A handler, and not SIG_IGN, which a program that is started would inherit.
void OnBrokenPipe(int /*signal*/) { reader_is_gone = 1; }

}  // namespace

void SecureStandardStreams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number is this one. It can be used the wrong way only.
    open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
  struct sigaction action {};
  action.sa_handler = OnBrokenPipe;
  action.sa_flags = SA_RESTART;
  sigaction(SIGPIPE, &action, nullptr);
  // A write beyond the limit of a file's size fails then, as on a full disk, instead of ending the
  // program.
  signal(SIGXFSZ, SIG_IGN);
}

void FlushOutput() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const std::string why = errno != 0 ? std::strerror(errno) : "a part of it is lost";
  if (reader_is_gone != 0) {
    signal(SIGPIPE, SIG_DFL);
    raise(SIGPIPE);
  }
  throw UserError("standard output", 0, "", "cannot be written: " + why);
}

}  // namespace howl
