#include "estimation/analysis/oscillations/notches_beside.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

constexpr double kMainLobeWidths = 2.0;  // of a Hann block, from its peak to the first null

}  // namespace

std::vector<Notch> NotchesBeside(std::span<const OscillationLine> lines, double cycle_hz,
                                 double slow_hz, double duration_s) {
  std::vector<OscillationLine> own = {{cycle_hz, 0.0, 1.0, 1.0}};
  if (slow_hz > 0.0) own.push_back({slow_hz, 0.0, 1.0, 1.0});
  std::vector<Notch> notches;
  for (const OscillationLine& line : lines) {
    const bool is_slow = slow_hz > 0.0 && line.frequency_hz == slow_hz;
    if (!is_slow && IsCombination(line, own)) continue;
    const auto notch = NotchBeside(line.frequency_hz, cycle_hz, duration_s);
    if (notch) notches.push_back(*notch);
  }
  return notches;
}

std::vector<Notch> NotchesOutside(std::span<const OscillationLine> lines, double low_hz,
                                  double high_hz, double duration_s) {
  std::vector<Notch> notches;
  for (const OscillationLine& line : lines) {
    if (line.frequency_hz >= low_hz && line.frequency_hz <= high_hz) continue;
    const auto notch = NotchBeside(line.frequency_hz, 0.5 * (low_hz + high_hz), duration_s);
    if (notch) notches.push_back(*notch);
  }
  return notches;
}

double BlockApart(std::span<const Notch> notches, double cycle_hz) {
  double longest = 0.0;
  for (const Notch& notch : notches) {
    longest = std::max(longest, kMainLobeWidths / std::abs(notch.frequency_hz - cycle_hz));
  }
  return longest;
}

}  // namespace howl
