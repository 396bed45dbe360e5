#include "app/process/progress_line.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace howl {
namespace {

constexpr std::chrono::duration<double> kPatience{2.0};
constexpr std::chrono::duration<double> kInterval{0.2};

}  // namespace

std::string DurationText(double seconds) {
  char text[32];
  if (seconds < 90.0) {
    std::snprintf(text, sizeof text, "%.0f s", std::ceil(seconds));
  } else {
    std::snprintf(text, sizeof text, "%.0f min", std::ceil(seconds / 60.0));
  }
  return text;
}

ProgressLine::ProgressLine(std::string what, bool quiet)
    : what_(std::move(what)),
      enabled_(!quiet && isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_shown_(start_) {}

void ProgressLine::Show(std::size_t done, std::size_t total) {
  if (!enabled_ || total == 0) return;
  const Clock::time_point now = Clock::now();
  if (done <= last_done_) start_ = now;
  last_done_ = done;
  if (done >= total) {
    Clear();
    last_done_ = 0;
    start_ = now;
    return;
  }
  const std::chrono::duration<double> elapsed = now - start_;
  if (elapsed < kPatience || (shown_ && now - last_shown_ < kInterval)) return;
  last_shown_ = now;
  shown_ = true;
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const std::string left = DurationText(elapsed.count() * (1.0 - share) / share);
  std::fprintf(stderr, "\r\033[K%s: %zu of %zu, %s left", what_.c_str(), done, total, left.c_str());
  std::fflush(stderr);
}

void ProgressLine::Clear() {
  if (!shown_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace howl
