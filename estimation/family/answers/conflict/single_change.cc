#include "estimation/family/answers/conflict/single_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "estimation/family/answers/conflict/change_search.h"
#include "estimation/family/bounds/feasible.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/drawer/window.h"

namespace howl {

namespace {

constexpr Range kBeyond{1e-3, 8e-3};  // of the change: how far beyond v* `pasted` may lie
constexpr double kLess = 0.99;

// Whether any change of the experiment's data can help, which it cannot where the other experiments
// have no member.
bool OthersHaveMember(const FamilyProblem& problem, std::size_t experiment,
                      std::span<const Member> known) {
  if (problem.experiments.size() == 1) return true;
  const auto at = static_cast<std::ptrdiff_t>(experiment);
  FamilyProblem others = problem;
  others.experiments.erase(others.experiments.begin() + at);
  if (HasExactWindows(others)) return DecideFeasible(others) == Feasibility::kMember;
  const std::span<const Member> last = LastOf(known);
  std::vector<Member> starts(last.begin(), last.end());
  for (Member& start : starts) start.erase(start.begin() + at);
  return FindMemberFrom(others, starts, false).has_value();
}

void Finish(ChangeSearch& search, SmallestChange& change) {
  const double by = *change.needed - change.value;
  // A number of few digits is tried first, and v* itself where that has no member.
  for (const double pasted :
       {ShortestBetween(*change.needed + kBeyond.lo * by, *change.needed + kBeyond.hi * by),
        *change.needed}) {
    std::optional<Member> member = search.MemberAt(pasted);
    if (!member) continue;
    change.helps = true;
    change.pasted = pasted;
    change.member = *std::move(member);
    change.less_is_proved_empty = search.IsEmptyAt(change.value + kLess * (pasted - change.value));
    return;
  }
}

}  // namespace

SmallestChange FindSmallestChange(const FamilyProblem& problem, const ChangeTarget& target,
                                  std::span<const Member> known) {
  SmallestChange change{.target = target, .value = ValueNow(problem, target)};
  ChangeSearch search(problem, target, known);
  if (target.IsSwitch()) {
    std::optional<Member> member = search.MemberAt(0.0);
    if (!member) return change;
    change.helps = true;
    change.pasted = 0.0;
    change.member = *std::move(member);
    return change;
  }
  if (target.kind == ChangeKind::kDatum) {
    // Draws at random are too coarse a search to find the edge of what a datum may be.
    change.searched = HasExactWindows(problem) || LocalSearch(problem).IsSupported() ||
                      DecideFeasible(problem, false) == Feasibility::kEmpty;
    if (!change.searched || !OthersHaveMember(problem, target.experiment, known)) return change;
    change.needed = search.NearestOfDatum();
  } else {
    change.needed = search.NearestOfMonotone();
  }
  if (change.needed) Finish(search, change);
  return change;
}

double ShortestBetween(double a, double b) {
  const double middle = 0.5 * (a + b);
  const auto [lo, hi] = std::minmax(a, b);
  for (int digits = 1; digits < 17; ++digits) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, middle);
    const double value = std::strtod(text.data(), nullptr);
    if (lo <= value && value <= hi) return value;
  }
  return middle;
}

}  // namespace howl
