// Ctrl-C asks for a stop; long work checks for it between units, saves what it has, and ends.
#ifndef HOWL_APP_PROCESS_INTERRUPTION_H_
#define HOWL_APP_PROCESS_INTERRUPTION_H_

#include <stdexcept>
#include <string>

namespace howl {

// The exit status with which a shell reports a program that Ctrl-C ended.
inline constexpr int kInterrupted = 130;

// Until WatchForInterruption(), SIGINT and SIGTERM end the program with one line on standard error
// and kInterrupted. `last_act` is done first, and may do what a signal handler may.
void EndWhenInterrupted(void (*last_act)());

// Catches SIGINT and SIGTERM from now on; a second one, half a second later or more, ends the
// program at once.
void WatchForInterruption();
bool IsInterrupted();

// Thrown when work stops early; what() says where it goes on from.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace howl

#endif  // HOWL_APP_PROCESS_INTERRUPTION_H_
