#include "app/child_process.h"

#include <fcntl.h>
#include <glog/logging.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "app/interruption.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr int kLookMs = 200;

class Pipe {
 public:
  Pipe() { CHECK_EQ(pipe2(ends_.data(), O_CLOEXEC), 0) << std::strerror(errno); }
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

}  // namespace

ChildResult RunChild(const std::vector<std::string>& words, const std::string& input) {
  // A program that ends before it has read its input must not end this one.
  signal(SIGPIPE, SIG_IGN);
  Pipe in;
  Pipe out;
  Pipe err;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = -1;
  const int failed =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    throw UserError(words[0], 0, "", std::string("cannot be started: ") + std::strerror(failed));
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
