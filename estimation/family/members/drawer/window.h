// The exact range in which the window of omega that omega_spread_max allows can lie, for one mode.
//
// With the window [v, S v], S = 1 + omega_spread_max, y = sinh(ln(f / omega)) and t = tan(-theta),
// an experiment's members fulfil y = xi t, so that xi has a partner in the window exactly where
//
//   xi t_hi >= y(S v)   and   xi t_lo <= y(v).
//
// The least xi of one experiment against the largest of another, multiplied by 2 v, is linear in
// v^2; the bounds on xi itself are a bound on v in closed form. The feasible v are therefore one
// interval without any search.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_WINDOW_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_WINDOW_H_

#include <optional>
#include <vector>

#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/targets.h"

namespace howl {

// How the xi of two experiments must compare for both to be in one member.
enum class XiRelation { kFree, kIncreasing, kShared };

struct WindowProblem {
  std::vector<ExperimentTarget> targets;
  double factor = 1.0;  // S; infinite without a limit on the spread
  Range xi;             // bounds of xi
  Range omega_hz;       // bounds of omega
  XiRelation relation = XiRelation::kIncreasing;
};

// (constant - slope v^2) / (2 v) bounds xi from below or from above, v being the window's low end.
struct XiBound {
  double constant = 0.0;
  double slope = 0.0;
};

struct XiBounds {
  std::vector<XiBound> lower;
  std::vector<XiBound> upper;
};

// The terms of one experiment with a finite window; bounds of xi itself are not among them.
XiBounds XiBoundsOf(const ExperimentTarget& target, double factor);

// Reads the above from a problem; tolerances shrunk by `margin` as in MakeTargets.
WindowProblem MakeWindowProblem(const FamilyProblem& problem, double margin = 1e-9);

// The interval of xi that has a partner omega within [window.lo, window.hi] and the phase range;
// lo > hi where there is none.
Range XiInWindow(const ExperimentTarget& target, const Range& window_hz, const Range& xi);

// The feasible low ends v of the window; no value when no v is feasible, so that the family is
// empty. With an infinite factor any v does, and the answer tells only of the rest.
std::optional<Range> FeasibleWindows(const WindowProblem& problem);

// The smallest largest-xi over all feasible windows.
std::optional<double> SmallestLargestXi(const WindowProblem& problem);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_WINDOW_H_
