// Where along a branch its cycles attract, and where two branches do at once.
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/cycles/continuation.h"

namespace howl {

std::vector<ParameterInterval> StableIntervals(const Branch& branch) {
  // Between neighbouring points a change of stability, or a fold, is at a listed bifurcation.
  std::vector<ParameterInterval> intervals;
  const auto end = [&](double a, double b) {
    double best = 0.5 * (a + b);
    double distance = HUGE_VAL;
    for (const Bifurcation& bifurcation : branch.bifurcations) {
      const double d = std::abs(bifurcation.parameter - 0.5 * (a + b));
      if (d < distance) {
        distance = d;
        best = bifurcation.parameter;
      }
    }
    return best;
  };
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    if (!branch.points[i].stable) continue;
    std::size_t last = i;
    while (last + 1 < branch.points.size() && branch.points[last + 1].stable) ++last;
    double from = branch.points[i].parameter;
    double to = branch.points[last].parameter;
    double lo = std::min(from, to);
    double hi = std::max(from, to);
    for (std::size_t k = i; k <= last; ++k) {
      lo = std::min(lo, branch.points[k].parameter);
      hi = std::max(hi, branch.points[k].parameter);
    }
    const auto widen = [&](double value) {
      lo = std::min(lo, value);
      hi = std::max(hi, value);
    };
    if (i > 0) widen(end(branch.points[i - 1].parameter, from));
    if (last + 1 < branch.points.size()) widen(end(to, branch.points[last + 1].parameter));
    // A branch that ends before the limit of the parameter ends at a Hopf bifurcation.
    for (const Bifurcation& b : branch.bifurcations) {
      if (b.kind != BifurcationKind::kHopf) continue;
      const bool after_last = last + 1 == branch.points.size() &&
                              std::abs(b.parameter - to) < std::abs(b.parameter - from);
      const bool before_first =
          i == 0 && std::abs(b.parameter - from) <= std::abs(b.parameter - to);
      if (after_last || before_first) widen(b.parameter);
    }
    intervals.push_back({lo, hi});
    i = last;
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const auto& l, const auto& r) { return l.lo < r.lo; });
  std::vector<ParameterInterval> merged;
  for (const ParameterInterval& interval : intervals) {
    if (!merged.empty() && interval.lo <= merged.back().hi) {
      merged.back().hi = std::max(merged.back().hi, interval.hi);
    } else {
      merged.push_back(interval);
    }
  }
  return merged;
}

std::vector<ParameterInterval> Intersect(const std::vector<ParameterInterval>& a,
                                         const std::vector<ParameterInterval>& b) {
  std::vector<ParameterInterval> both;
  for (const ParameterInterval& x : a) {
    for (const ParameterInterval& y : b) {
      const double lo = std::max(x.lo, y.lo);
      const double hi = std::min(x.hi, y.hi);
      if (lo < hi) both.push_back({lo, hi});
    }
  }
  return both;
}

}  // namespace howl
