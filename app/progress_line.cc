#include "app/progress_line.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace howl {
namespace {

constexpr std::chrono::duration<double> kPatience{2.0};
constexpr std::chrono::duration<double> kInterval{0.2};

std::string Duration(double seconds) {
  char text[32];
  if (seconds < 90.0) {
    std::snprintf(text, sizeof text, "%.0f s", std::ceil(seconds));
  } else {
    std::snprintf(text, sizeof text, "%.0f min", std::ceil(seconds / 60.0));
  }
  return text;
}

}  // namespace

ProgressLine::ProgressLine(std::string what, bool quiet)
    : what_(std::move(what)),
      enabled_(!quiet && isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

void ProgressLine::Show(std::size_t done, std::size_t total) {
  if (!enabled_ || total == 0) return;
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> elapsed = now - start_;
  if (elapsed < kPatience || (shown_ && now - last_ < kInterval)) return;
  last_ = now;
  shown_ = true;
  const double share = static_cast<double>(done) / static_cast<double>(total);
  std::string text = what_ + ": " + std::to_string(done) + " of " + std::to_string(total);
  if (done > 0) text += ", " + Duration(elapsed.count() * (1.0 - share) / share) + " left";
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
}

void ProgressLine::Clear() {
  if (!shown_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace howl
