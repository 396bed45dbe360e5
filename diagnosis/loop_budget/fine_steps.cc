#include "diagnosis/loop_budget/fine_steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "diagnosis/numerics/hann_power.h"

namespace howl {
namespace {

// Samples are written with six digits at least.
constexpr double kOffTheLattice = 1e-2;  // of a step
constexpr double kShareOfFloor = 0.5;

// The variance of white noise with the power that the signal has at its upper frequencies.
double FloorOf(const std::vector<double>& signal) {
  const Eigen::VectorXd spectrum = HannPower(signal);
  const Eigen::Index from = spectrum.size() / 2;
  std::vector<double> power(spectrum.begin() + from, spectrum.end());
  if (power.empty()) return 0.0;
  const auto middle = power.begin() + static_cast<std::ptrdiff_t>(power.size() / 2);
  std::ranges::nth_element(power, middle);
  return *middle / std::numbers::ln2;
}

}  // namespace

int LevelsOfFineSteps(const std::vector<double>& signal) {
  std::vector<double> values = signal;
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 2 || values.size() > kMostLevels) return 0;
  double step = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    step = std::min(step, values[i] - values[i - 1]);
  }
  const double levels = (values.back() - values.front()) / step;
  if (levels > kMostLevels) return 0;
  for (const double value : values) {
    const double steps = (value - values.front()) / step;
    if (std::abs(steps - std::round(steps)) > kOffTheLattice * std::max(1.0, steps / levels)) {
      return 0;
    }
  }
  if (step * step / 12.0 < kShareOfFloor * FloorOf(signal)) return 0;
  return static_cast<int>(std::lround(levels)) + 1;
}

}  // namespace howl
