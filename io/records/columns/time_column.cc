#include "io/records/columns/time_column.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "estimation/analysis/spectra/statistics.h"
#include "io/records/columns/number_text.h"

namespace howl {
namespace {

constexpr double kJitter = 0.1;  // of a step
constexpr double kGap = 0.5;     // beyond a step, of a step: half a sample is missing
constexpr double kFewSteps = 1e-3;
constexpr std::size_t kLooked = 1000;

// The coarsest 10^-k s on which the times lie, found to lie there within their own rounding; 0
// where that is too coarse to tell, and BinaryResolution the larger.
double DecimalResolution(std::span<const double> times) {
  for (int decimals = 0; decimals <= 15; ++decimals) {
    const double per_second = std::pow(10.0, decimals);
    const bool on_grid = std::all_of(times.begin(), times.end(), [&](double time) {
      const double scaled = time * per_second;
      const double rounding = std::numeric_limits<double>::epsilon() * std::abs(scaled);
      return rounding < 0.5 && std::abs(scaled - std::round(scaled)) <= rounding;
    });
    if (on_grid) return 1.0 / per_second;
  }
  return 0.0;
}

// Times whose steps are one multiple of the grid, but for a few, were not rounded to it: the
// sampling period is a decimal number itself, and the few are faults.
bool IsSamplingGrid(std::span<const double> times, double grid_s) {
  std::vector<double> some;
  const std::size_t stride = std::max<std::size_t>(1, times.size() / kLooked);
  for (std::size_t i = 1; i < times.size(); i += stride) some.push_back(times[i] - times[i - 1]);
  if (some.empty()) return true;
  const double typical = std::round(Median(some) / grid_s);
  std::size_t others = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    others += std::abs((times[i] - times[i - 1]) / grid_s - typical) > 0.5 ? 1 : 0;
  }
  return static_cast<double>(others) < kFewSteps * static_cast<double>(times.size());
}

double BinaryResolution(std::span<const double> times) {
  double largest = 0.0;
  bool single_precision = true;
  for (const double time : times) {
    largest = std::max(largest, std::abs(time));
    single_precision = single_precision && static_cast<double>(static_cast<float>(time)) == time;
  }
  return largest * (single_precision ? std::numeric_limits<float>::epsilon()
                                     : 2.0 * std::numeric_limits<double>::epsilon());
}

std::string Describe(const char* what, double step_s, double expected_s) {
  return std::string(what) + " of " + NumberText(step_s, 3) + " s, expected even steps of " +
         NumberText(expected_s, 3) + " s";
}

}  // namespace

double TimeResolution(std::span<const double> time_s) {
  const std::size_t looked = std::min(kLooked, time_s.size());
  double binary = 0.0;
  double decimal = 0.0;
  // Numbers printed to a fixed count of digits have fewer decimals where they are large.
  for (const auto& part : {time_s.first(looked), time_s.last(looked)}) {
    binary = std::max(binary, BinaryResolution(part));
    decimal = std::max(decimal, DecimalResolution(part));
  }
  return decimal > binary && !IsSamplingGrid(time_s, decimal) ? decimal : binary;
}

double TypicalStep(std::span<const double> time_s, double resolution_s) {
  const std::size_t n = time_s.size();
  // Over enough samples that the resolution is a hundredth of the time between them.
  for (std::size_t lag = 1; lag < n; lag *= 2) {
    std::vector<double> steps;
    const std::size_t stride = std::max<std::size_t>(1, (n - lag) / kLooked);
    for (std::size_t i = 0; i + lag < n; i += stride) {
      steps.push_back(time_s[i + lag] - time_s[i]);
    }
    const double middle = Median(steps);
    if (middle >= 100.0 * resolution_s || 4 * lag >= n) {
      return std::max(0.0, middle / static_cast<double>(lag));
    }
  }
  return 0.0;
}

std::optional<TimeFault> FindTimeFault(std::span<const double> time_s, double step_s,
                                       double resolution_s, double unit_s) {
  const auto describe = [&](const char* what, double step) {
    return Describe(what, step * unit_s, step_s * unit_s);
  };
  // Both ends of a step are rounded, each by half the resolution; a little for the arithmetic.
  const double rounding = 1.01 * resolution_s;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step = time_s[i] - time_s[i - 1];
    const double excess = step - step_s;
    if (std::abs(excess) <= kJitter * step_s + rounding && step >= 0.0) continue;
    if (step < 0.0) return TimeFault{i, describe("time goes backwards by a step", step)};
    if (step == 0.0) return TimeFault{i, describe("time stands still, a step", step)};
    const bool gap = excess > kGap * step_s + rounding;
    return TimeFault{i, describe(gap ? "a time gap" : "an uneven time step", step)};
  }
  return std::nullopt;
}

double SamplingRateHz(std::span<const double> time_s, double resolution_s) {
  const double span_s = time_s.back() - time_s.front();
  const double rate_hz = static_cast<double>(time_s.size() - 1) / span_s;
  const double uncertainty_hz = rate_hz * resolution_s / span_s;
  for (int digits = 1; digits < 17; ++digits) {
    const double rounded = RoundedTo(rate_hz, digits);
    if (std::abs(rounded - rate_hz) <= uncertainty_hz) return rounded;
  }
  return rate_hz;
}

}  // namespace howl
