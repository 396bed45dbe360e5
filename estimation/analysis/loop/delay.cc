#include "estimation/analysis/loop/delay.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "estimation/analysis/loop/closed_form.h"
#include "model/numerics/units.h"

namespace howl {

namespace {

constexpr double kDecided = 0.95;

// Spreads below the clock and text of any record count as equal.
constexpr double kLeastSpread = 1e-9;

// The branches, the most probable first; phases must have been unwrapped about their mean.
std::vector<DelayBranch> CompareDelayBranches(std::span<const DelayInput> inputs, int max_branch) {
  std::vector<DelayBranch> branches;
  const double n = static_cast<double>(inputs.size());
  for (int k = -1; k <= max_branch && inputs.size() >= 3; ++k) {
    double sum = 0.0, squares = 0.0;
    bool positive = true;
    for (const DelayInput& input : inputs) {
      const double tau_s = DelayOnBranch(input, k).value;
      positive = positive && tau_s > 0.0;
      sum += tau_s;
      squares += tau_s * tau_s;
    }
    const double mean = sum / n;
    const double variance = std::max(squares / n - mean * mean, 0.0) * n / (n - 1.0);
    if (positive) branches.push_back({k, mean, std::sqrt(variance) / mean, 0.0});
  }
  std::stable_sort(branches.begin(), branches.end(),
                   [](const DelayBranch& a, const DelayBranch& b) { return a.spread < b.spread; });
  double total = 0.0;
  for (DelayBranch& branch : branches) {
    const double relative =
        std::max(branches.front().spread, kLeastSpread) / std::max(branch.spread, kLeastSpread);
    branch.probability = std::pow(relative, n - 1.0);
    total += branch.probability;
  }
  for (DelayBranch& branch : branches) branch.probability /= total;
  return branches;
}

}  // namespace

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
  choice.branches = CompareDelayBranches(inputs, max_branch);
  if (branch.has_value()) {
    choice.branch = *branch;
    choice.given = true;
  } else if (!choice.branches.empty() && choice.branches.front().probability >= kDecided) {
    choice.branch = choice.branches.front().branch;
    choice.by_consistency = true;
  }
  for (const DelayInput& input : inputs) {
    choice.tau_s.push_back(DelayOnBranch(input, choice.branch));
  }
  return choice;
}

}  // namespace howl
