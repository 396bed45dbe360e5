#include "estimation/family/members/two_mode_tradeoff.h"

#include <algorithm>
#include <cmath>

#include "estimation/family/members/greedy_chain.h"

namespace howl {

bool HasGreedyTradeoff(const FamilyProblem& problem) {
  if (problem.model.modes != 2 || !problem.model.own.empty() || !problem.test.xi_increasing ||
      problem.HasTransfer()) {
    return false;
  }
  if (std::ranges::any_of(problem.experiments, [&](const Experiment& experiment) {
        return TestsLineGain(experiment, problem.test);
      })) {
    return false;
  }
  const bool shares_m = problem.IsShared(ParameterKind::kM);
  if (!shares_m && !problem.IsShared(ParameterKind::kMOverN)) return false;
  for (const ParameterKind kind :
       {ParameterKind::kOmega, ParameterKind::kXi, ParameterKind::kN, ParameterKind::kTau}) {
    if (problem.IsShared(kind)) return false;
  }
  return std::isfinite(problem.RangeOf(shares_m ? ParameterKind::kM : ParameterKind::kMOverN).hi) &&
         std::isfinite(problem.test.omega_spread_max);
}

std::vector<Member> ExtremeMembers(const FamilyProblem& problem) {
  constexpr int kSeconds = 10;
  constexpr int kWindows = 50;
  constexpr int kHalvings = 16;
  const GreedyChain greedy(problem);
  const Range range = problem.RangeOf(problem.IsShared(ParameterKind::kM) ? ParameterKind::kM
                                                                          : ParameterKind::kMOverN);
  const Range windows = greedy.Windows();
  std::vector<Member> members;
  for (int m = 0; m <= kSeconds; ++m) {
    const double u = static_cast<double>(m) / kSeconds;
    const double second = m == kSeconds
                              ? range.hi
                              : std::max(range.lo + (range.hi - range.lo) * u * u, 1e-6 * range.hi);
    const auto reaches = [&](double v) {
      const std::size_t before = members.size();
      greedy.Extremes(second, v, members);
      return members.size() > before;
    };
    const double step = (windows.hi - windows.lo) / kWindows;
    bool before = false;
    for (int k = 0; k <= kWindows; ++k) {
      const double v = windows.lo + step * k;
      const bool here = reaches(v);
      if (k > 0 && here != before) {
        // The edge of the windows that have members, where parameters reach farthest.
        double good = here ? v : v - step;
        double bad = here ? v - step : v;
        for (int halving = 0; halving < kHalvings; ++halving) {
          const double middle = 0.5 * (good + bad);
          (reaches(middle) ? good : bad) = middle;
        }
      }
      before = here;
    }
  }
  return members;
}

std::optional<double> GreedySmallestXi(const FamilyProblem& problem) {
  const GreedyChain greedy(problem);
  const Range range = problem.RangeOf(problem.IsShared(ParameterKind::kM) ? ParameterKind::kM
                                                                          : ParameterKind::kMOverN);
  // Even in the root: towards zero the second mode fades out. Zero itself is not a second mode.
  constexpr int kGrid = 12;
  const double u_lo = std::sqrt(std::max(range.lo, 1e-6 * range.hi));
  const double u_hi = std::sqrt(range.hi);
  const auto at = [&](double u) { return greedy.LargestXi(std::min(u * u, range.hi)); };
  double best_u = u_lo;
  double best = GreedyChain::kUnreached;
  double step = (u_hi - u_lo) / kGrid;
  for (int k = 0; k <= kGrid; ++k) {
    const double u = u_lo + step * k;
    const double xi = at(u);
    if (xi < best) {
      best = xi;
      best_u = u;
    }
  }
  if (!std::isfinite(best)) return std::nullopt;
  for (int round = 0; round < 16 && step > 0.0; ++round) {
    step *= 0.5;
    for (const double u : {std::max(u_lo, best_u - step), std::min(u_hi, best_u + step)}) {
      const double xi = at(u);
      if (xi < best) {
        best = xi;
        best_u = u;
      }
    }
  }
  return best;
}

}  // namespace howl
