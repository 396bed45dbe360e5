#include "app/process/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "app/process/interruption.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr int kLookMs = 200;

[[noreturn]] void FailToStart(const std::string& program, int error) {
  throw UserError(program, 0, "", std::string("cannot be started: ") + std::strerror(error));
}

class Pipe {
 public:
  explicit Pipe(const std::string& program) {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) FailToStart(program, errno);
  }
  ~Pipe() {
    Close(0);
    Close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int operator[](std::size_t end) const { return ends_[end]; }
  void Close(std::size_t end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

// True while there may be more.
bool ReadSome(int descriptor, std::string& text) {
  std::array<char, 65536> buffer{};
  const ssize_t got = read(descriptor, buffer.data(), buffer.size());
  if (got < 0) return errno == EINTR || errno == EAGAIN;
  text.append(buffer.data(), static_cast<std::size_t>(got));
  return got > 0;
}

int Wait(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// What the child does between fork and exec, with nothing that takes a lock: other threads may have
// held it. The child ends with this program, even where that is killed: it would write where the
// next run does. Writes why it failed to `fault`, which closes where it did not.
[[noreturn]] void BecomeChild(pid_t parent, const std::array<int, 3>& streams, char** arguments,
                              int fault) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it has ended already
  for (int stream = 0; stream < 3; ++stream) {
    dup2(streams[static_cast<std::size_t>(stream)], stream);
  }
  execv(arguments[0], arguments);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(fault, &error, sizeof error);
  _exit(1);
}

}  // namespace

ChildResult RunChild(const std::vector<std::string>& words, const std::string& input) {
  Pipe in(words[0]);
  Pipe out(words[0]);
  Pipe err(words[0]);
  Pipe fault(words[0]);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t self = getpid();
  const pid_t child = fork();
  if (child < 0) FailToStart(words[0], errno);
  if (child == 0) {
    BecomeChild(self, {in[0], out[1], err[1]}, arguments.data(), fault[1]);
  }
  fault.Close(1);
  int failed = 0;
  ssize_t got = -1;
  while ((got = read(fault[0], &failed, sizeof failed)) < 0 && errno == EINTR) {
  }
  if (got == sizeof failed) {
    Wait(child);
    FailToStart(words[0], failed);
  }
  in.Close(0);
  out.Close(1);
  err.Close(1);
  fcntl(in[1], F_SETFL, O_NONBLOCK);

  ChildResult result;
  std::size_t sent = 0;
  bool told = false;
  while (out[0] >= 0 || err[0] >= 0) {
    if (sent == input.size()) in.Close(1);
    std::array<pollfd, 3> watched = {
        {{in[1], POLLOUT, 0}, {out[0], POLLIN, 0}, {err[0], POLLIN, 0}}};
    poll(watched.data(), watched.size(), kLookMs);
    if (IsInterrupted() && !told) {
      kill(child, SIGTERM);
      told = true;
    }
    if (in[1] >= 0 && watched[0].revents != 0) {
      const ssize_t written = write(in[1], input.data() + sent, input.size() - sent);
      if (written > 0) sent += static_cast<std::size_t>(written);
      if (written < 0 && errno != EINTR && errno != EAGAIN) sent = input.size();
    }
    if (out[0] >= 0 && watched[1].revents != 0 && !ReadSome(out[0], result.out)) out.Close(0);
    if (err[0] >= 0 && watched[2].revents != 0 && !ReadSome(err[0], result.err)) err.Close(0);
  }
  result.status = Wait(child);
  return result;
}

std::filesystem::path ThisProgram() { return std::filesystem::read_symlink("/proc/self/exe"); }

std::filesystem::path ProgramFolder() { return ThisProgram().parent_path(); }

}  // namespace howl
