#include <algorithm>
#include <cmath>

#include "estimation/family/answers/predict/predict.h"
#include "estimation/family/answers/predict/predict_points.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr int kSteps = 200;  // of a side's range, each searched for one change of sign
constexpr int kHalvings = 40;

// NaN if there is no crossing on the way; a path that has no loop further on has no crossing there.
double FirstCrossing(const OperatingPoints& points, const MemberPath& path, double from,
                     double to) {
  double before = from;
  for (int step = 1; step <= kSteps; ++step) {
    const double here = from + (to - from) * step / kSteps;
    const std::optional<double> gain = path.LogLoopGain(points, here);
    if (!gain) return std::nan("");
    if (*gain <= 0.0) {
      double unstable = before, stable = here;
      for (int halving = 0; halving < kHalvings; ++halving) {
        const double middle = 0.5 * (unstable + stable);
        const std::optional<double> there = path.LogLoopGain(points, middle);
        (there && *there > 0.0 ? unstable : stable) = middle;
      }
      return 0.5 * (unstable + stable);
    }
    before = here;
  }
  return std::nan("");
}

// `away`: +1 going up, -1 going down. NaN is further away than any number.
CycleEnd EndOf(std::vector<double> crossings, double away) {
  CycleEnd end;
  if (crossings.empty()) {
    end.median = end.lo = end.hi = away * HUGE_VAL;
    return end;
  }
  std::size_t crossing = 0;
  for (double& each : crossings) {
    if (std::isfinite(each)) {
      ++crossing;
    } else {
      each = away * HUGE_VAL;
    }
  }
  std::ranges::sort(crossings);
  end = {NearestRank(crossings, 0.5), NearestRank(crossings, 0.025), NearestRank(crossings, 0.975),
         static_cast<double>(crossing) / static_cast<double>(crossings.size())};
  return end;
}

}  // namespace

std::optional<CycleLimits> FindCycleLimits(const OperatingPoints& points,
                                           std::span<const MemberPath> paths, int threads) {
  if (points.size() < 2 || paths.empty()) return std::nullopt;
  std::optional<std::size_t> start;
  double highest = -HUGE_VAL;
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::vector<double> gains;
    for (const MemberPath& path : paths) {
      gains.push_back(path.LogLoopGain(points, points.phi(k)).value_or(std::nan("")));
    }
    const double median = Summarise(std::move(gains)).median;
    if (std::isfinite(median) && median > highest) {
      highest = median;
      start = k;
    }
  }
  if (!start) return std::nullopt;
  CycleLimits limits;
  limits.from_phi = points.phi(*start);
  std::vector<const MemberPath*> unstable;
  for (const MemberPath& path : paths) {
    if (path.LogLoopGain(points, limits.from_phi).value_or(0.0) > 0.0) unstable.push_back(&path);
  }
  limits.share_unstable = static_cast<double>(unstable.size()) / static_cast<double>(paths.size());
  std::vector<double> below(unstable.size()), above(unstable.size());
  const double lowest_phi = points.phi(0) - points.width();
  const double highest_phi = points.phi(points.size() - 1) + points.width();
  RunUnits(unstable.size(), threads, [&](std::size_t k) {
    below[k] = FirstCrossing(points, *unstable[k], limits.from_phi, lowest_phi);
    above[k] = FirstCrossing(points, *unstable[k], limits.from_phi, highest_phi);
  });
  limits.below = EndOf(std::move(below), -1.0);
  limits.above = EndOf(std::move(above), 1.0);
  return limits;
}

}  // namespace howl
