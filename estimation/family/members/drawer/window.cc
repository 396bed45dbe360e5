#include "estimation/family/members/drawer/window.h"

#include <cmath>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/members/drawer/chain.h"
#include "model/numerics/constants.h"

namespace howl {

namespace {

// xi >= (or <=) y(sigma v) / t: times 2 v it is constant - slope v^2.
XiBound BoundAt(double frequency_hz, double sigma, double t) {
  return {frequency_hz / (sigma * t), sigma / (frequency_hz * t)};
}

double TangentLo(const ExperimentTarget& target) { return std::tan(-target.phase_rad.hi); }
double TangentHi(const ExperimentTarget& target) { return std::tan(-target.phase_rad.lo); }

bool MustNotExceed(const WindowProblem& problem, std::size_t j, std::size_t i) {
  if (i == j || problem.relation == XiRelation::kShared) return true;
  return problem.relation == XiRelation::kIncreasing &&
         problem.targets[j].phi < problem.targets[i].phi;
}

}  // namespace

XiBounds XiBoundsOf(const ExperimentTarget& target, double factor) {
  XiBounds bounds;
  const double t_lo = TangentLo(target);
  const double t_hi = TangentHi(target);
  if (std::isfinite(factor)) {
    if (t_hi > 0.0) bounds.lower.push_back(BoundAt(target.frequency_hz, factor, t_hi));
    if (t_hi < 0.0) bounds.upper.push_back(BoundAt(target.frequency_hz, factor, t_hi));
    if (t_lo > 0.0) bounds.upper.push_back(BoundAt(target.frequency_hz, 1.0, t_lo));
    if (t_lo < 0.0) bounds.lower.push_back(BoundAt(target.frequency_hz, 1.0, t_lo));
  }
  return bounds;
}

WindowProblem MakeWindowProblem(const FamilyProblem& problem, double margin) {
  WindowProblem window;
  window.targets = MakeTargets(problem, margin);
  window.factor = problem.IsShared(ParameterKind::kOmega)
                      ? 1.0
                      : 1.0 + problem.test.omega_spread_max * (1.0 - margin);
  window.xi = problem.RangeOf(ParameterKind::kXi);
  window.xi.hi = std::min(window.xi.hi, problem.test.xi_max);
  window.omega_hz = problem.RangeOf(ParameterKind::kOmega);
  if (problem.IsShared(ParameterKind::kXi)) {
    window.relation = XiRelation::kShared;
  } else {
    window.relation = problem.test.xi_increasing ? XiRelation::kIncreasing : XiRelation::kFree;
  }
  return window;
}

Range XiInWindow(const ExperimentTarget& target, const Range& window_hz, const Range& xi) {
  Range range = xi;
  const double t_lo = TangentLo(target);
  const double t_hi = TangentHi(target);
  const auto at_least = [&](double t, double y) {  // xi t >= y
    if (t > 0.0) {
      range.lo = std::max(range.lo, y / t);
    } else if (t < 0.0) {
      range.hi = std::min(range.hi, y / t);
    } else if (y > 0.0) {
      range.hi = -1.0;
    }
  };
  if (std::isfinite(window_hz.hi)) at_least(t_hi, Detuning(target.frequency_hz, window_hz.hi));
  if (window_hz.lo > 0.0) at_least(-t_lo, -Detuning(target.frequency_hz, window_hz.lo));
  if (!(range.hi > 0.0)) range = {1.0, -1.0};  // xi is positive
  return range;
}

std::optional<Range> FeasibleWindows(const WindowProblem& problem) {
  const double factor = problem.factor;
  Range v{0.0, kInfinity};
  for (const ExperimentTarget& target : problem.targets) {
    if (target.IsEmpty()) return std::nullopt;
    const double t_lo = TangentLo(target);
    const double t_hi = TangentHi(target);
    const double xi_hi = std::min(problem.xi.hi, 1e6);
    const double y_max = std::max(xi_hi * t_hi, problem.xi.lo * t_hi);
    const double y_min = std::min(xi_hi * t_lo, problem.xi.lo * t_lo);
    // omega of this experiment lies in [lowest, highest], which the window must meet.
    const double lowest =
        std::max(OmegaFromDetuning(target.frequency_hz, y_max), problem.omega_hz.lo);
    const double highest =
        std::min(OmegaFromDetuning(target.frequency_hz, y_min), problem.omega_hz.hi);
    if (!(lowest <= highest)) return std::nullopt;
    v.lo = std::max(v.lo, lowest / factor);
    v.hi = std::min(v.hi, highest);
  }
  if (std::isfinite(factor)) {
    Range square{v.lo * v.lo, v.hi * v.hi};
    std::vector<XiBounds> bounds;
    for (const ExperimentTarget& target : problem.targets) {
      bounds.push_back(XiBoundsOf(target, factor));
    }
    for (std::size_t j = 0; j < problem.targets.size(); ++j) {
      for (std::size_t i = 0; i < problem.targets.size(); ++i) {
        if (!MustNotExceed(problem, j, i)) continue;
        for (const XiBound& a : bounds[j].lower) {
          for (const XiBound& b : bounds[i].upper) {
            // a.constant - a.slope q <= b.constant - b.slope q
            const double slope = a.slope - b.slope;
            const double constant = a.constant - b.constant;
            if (slope > 0.0) {
              square.lo = std::max(square.lo, constant / slope);
            } else if (slope < 0.0) {
              square.hi = std::min(square.hi, constant / slope);
            } else if (constant > 0.0) {
              return std::nullopt;
            }
          }
        }
      }
    }
    if (!(square.lo <= square.hi)) return std::nullopt;
    v = {std::sqrt(square.lo), std::sqrt(square.hi)};
  }
  // Bounds of xi itself against the others' bounds: each is monotone, and chained through
  // XiInWindow at the ends; what is left is the order relation with xi.lo and xi.hi.
  return v.lo <= v.hi ? std::optional<Range>(v) : std::nullopt;
}

std::optional<double> SmallestLargestXi(const WindowProblem& problem) {
  const std::optional<Range> windows = FeasibleWindows(problem);
  if (!windows) return std::nullopt;
  if (!std::isfinite(problem.factor)) return problem.xi.lo;
  // Largest over experiments of the least xi: of those that fall with v, and of those that rise.
  const auto least = [&](double v, bool falling) {
    double xi = problem.xi.lo;
    for (const ExperimentTarget& target : problem.targets) {
      const double t = falling ? TangentHi(target) : TangentLo(target);
      if (falling ? t > 0.0 : t < 0.0) {
        xi = std::max(xi, Detuning(target.frequency_hz, falling ? problem.factor * v : v) / t);
      }
    }
    return xi;
  };
  double lo = windows->lo;
  double hi = windows->hi;
  if (least(hi, true) >= least(hi, false)) return least(hi, true);
  if (least(lo, false) >= least(lo, true)) return least(lo, false);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double middle = 0.5 * (lo + hi);
    (least(middle, true) > least(middle, false) ? lo : hi) = middle;
  }
  return std::max(least(hi, true), least(hi, false));
}

}  // namespace howl
