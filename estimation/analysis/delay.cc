#include "estimation/analysis/delay.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "estimation/analysis/closed_form.h"
#include "model/units.h"

namespace howl {

Estimate DelayOnBranch(const DelayInput& input, int branch) {
  const double f = input.frequency_hz.value;
  const double tau_s = DelayFromPhase(f, input.phase_deg.value, branch);
  const double phase_std = std::isfinite(input.phase_deg.std) ? input.phase_deg.std : 0.0;
  const double frequency_std = std::isfinite(input.frequency_hz.std) ? input.frequency_hz.std : 0.0;
  return {tau_s, std::hypot(phase_std / 360.0, tau_s * frequency_std) / f};
}

DelayChoice EstimateDelays(std::span<const DelayInput> given, std::optional<int> branch,
                           int max_branch) {
  DelayChoice choice;
  // Phases on both sides of 180 degrees belong together: each is taken nearest to their mean.
  std::vector<DelayInput> inputs(given.begin(), given.end());
  std::complex<double> mean_phasor = 0.0;
  for (const DelayInput& input : inputs) {
    mean_phasor += std::polar(1.0, input.phase_deg.value * kRadPerDeg);
  }
  const double mean_deg = std::arg(mean_phasor) * kDegPerRad;
  for (DelayInput& input : inputs) {
    input.phase_deg.value = mean_deg + WrapDeg(input.phase_deg.value - mean_deg);
  }
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (const DelayInput& input : inputs) {
    lowest = std::min(lowest, input.frequency_hz.value);
    highest = std::max(highest, input.frequency_hz.value);
  }
  for (int k = -1; k <= max_branch && inputs.size() >= 3; ++k) {
    double sum = 0.0, squares = 0.0;
    bool positive = true;
    for (const DelayInput& input : inputs) {
      const double tau_s = DelayOnBranch(input, k).value;
      positive = positive && tau_s > 0.0;
      sum += tau_s;
      squares += tau_s * tau_s;
    }
    const double n = static_cast<double>(inputs.size());
    const double mean = sum / n;
    const double variance = std::max(squares / n - mean * mean, 0.0) * n / (n - 1.0);
    if (positive) choice.branches.push_back({k, mean, std::sqrt(variance) / mean});
  }
  double sum = 0.0, squares = 0.0;
  for (const DelayInput& input : inputs) {
    sum += 1.0 / input.frequency_hz.value;
    squares += 1.0 / (input.frequency_hz.value * input.frequency_hz.value);
  }
  const double n = static_cast<double>(inputs.size());
  const double period_spread =
      std::sqrt(std::max(squares / n - sum * sum / (n * n), 0.0) * n / std::max(n - 1.0, 1.0)) /
      (sum / n);
  std::sort(choice.branches.begin(), choice.branches.end(),
            [](const DelayBranch& a, const DelayBranch& b) { return a.spread < b.spread; });
  if (branch.has_value()) {
    choice.branch = *branch;
  } else if (!choice.branches.empty() && highest > 1.01 * lowest &&
             choice.branches.front().spread < 0.5 * period_spread) {
    choice.branch = choice.branches.front().branch;
    choice.by_consistency = true;
  }
  for (const DelayInput& input : inputs) {
    choice.tau_s.push_back(DelayOnBranch(input, choice.branch));
  }
  return choice;
}

}  // namespace howl
