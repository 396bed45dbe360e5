#include "app/process/interruption.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <string_view>

namespace howl {
namespace {

std::atomic<bool> interrupted{false};
std::atomic<long long> first_ns{0};
std::atomic<void (*)()> last_act{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<long long>::is_always_lock_free,
              "a signal handler may touch them");

constexpr long long kAgainNs = 500'000'000;

// The first signal asks for an orderly end, and a later one ends the program at once. One that
// follows within half a second is the same request, because timeout(1) and a terminal signal both a
// process and its group.
void OnSignal(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const long long ns = static_cast<long long>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
  if (!interrupted.exchange(true)) {
    first_ns = ns;
  } else if (ns - first_ns > kAgainNs) {
    ::signal(signal, SIG_DFL);
    raise(signal);
  }
}

void EndOnSignal(int /*signal*/) {
  if (void (*const act)() = last_act.load()) act();
  constexpr std::string_view kSaid = "howl: interrupted\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kSaid.data(), kSaid.size());
  _exit(kInterrupted);
}

void Watch(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

}  // namespace

void WatchForInterruption() {
  Watch(SIGINT, OnSignal);
  Watch(SIGTERM, OnSignal);
}

void EndWhenInterrupted(void (*act)()) {
  last_act = act;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction now {};
    // A shell gives what it runs in the background no Ctrl-C.
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) continue;
    Watch(signal, EndOnSignal);
  }
}

bool IsInterrupted() { return interrupted; }

}  // namespace howl
