// Progress on standard error, with the time that remains: from two seconds on, on a terminal only,
// and never when quiet.
#ifndef HOWL_APP_PROCESS_PROGRESS_LINE_H_
#define HOWL_APP_PROCESS_PROGRESS_LINE_H_

#include <chrono>
#include <cstddef>
#include <string>

namespace howl {

class ProgressLine {
 public:
  ProgressLine(std::string what, bool quiet);
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Must not be called from two threads at once. The line is removed when all is done; a count that
  // falls back begins the next stretch of work.
  void Show(std::size_t done, std::size_t total);
  void Clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool enabled_ = false;
  bool shown_ = false;
  std::size_t last_done_ = 0;
  Clock::time_point start_;
  Clock::time_point last_shown_;
};

// "12 s" or "3 min".
std::string DurationText(double seconds);

}  // namespace howl

#endif  // HOWL_APP_PROCESS_PROGRESS_LINE_H_
