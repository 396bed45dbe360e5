#include "estimation/family/answers/conflict/change_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/family/answers/conflict/limits.h"
#include "estimation/family/answers/conflict/without.h"
#include "estimation/family/bounds/feasible.h"
#include "estimation/family/bounds/proof.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/drawer/window.h"
#include "model/numerics/constants.h"

namespace howl {

namespace {

constexpr double kSearched = 1e-3;  // of the change: how near to v* a search comes
constexpr double kExact = 1e-9;     // the same where exact windows decide
constexpr int kRounds = 3;          // of bisection and draws
constexpr std::size_t kStarts = 3;  // of a local search, from members of related families

// The value of a limit or a bound that the member would just pass.
double ValuePassed(const FamilyProblem& problem, const ChangeTarget& target, const Member& member) {
  if (target.kind == ChangeKind::kCondition) return LimitPassed(problem, member, target.condition);
  double passed = target.is_upper ? 0.0 : kInfinity;
  for (const LoopModel& model : member) {
    const double value = ParameterOf(model, target.parameter);
    passed = target.is_upper ? std::max(passed, value) : std::min(passed, value);
  }
  return passed;
}

bool GrowsUpwards(const ChangeTarget& target) {
  return target.kind == ChangeKind::kCondition ? !IsLeast(target.condition) : target.is_upper;
}

// The effort grows where the last round's search had missed a member.
Effort EffortOf(int round) {
  return round == 0 ? Effort::kQuick : (round == 1 ? Effort::kUsual : Effort::kThorough);
}

}  // namespace

std::span<const Member> LastOf(std::span<const Member> known) {
  return known.last(std::min(kStarts, known.size()));
}

bool ChangeSearch::HasMember(double value, Effort effort) {
  const FamilyProblem at = Changed(problem_, target_, value);
  if (HasExactWindows(at)) return FeasibleWindows(MakeWindowProblem(at, 0.0)).has_value();
  const bool is_quick = effort == Effort::kQuick && member_ && LocalSearch(at).IsSupported();
  std::optional<Member> found = is_quick
                                    ? FindMemberNear(at, *member_)
                                    : FindMemberFrom(at, Starts(), effort == Effort::kThorough);
  if (!found) return false;
  member_ = std::move(found);
  return true;
}

std::optional<double> ChangeSearch::NearestOfMonotone() {
  const std::optional<double> reached = HasExactWindows(problem_) ? WideEnough() : FromOff();
  if (!reached) return std::nullopt;
  double wide = *reached;
  for (int round = 0; round < kRounds; ++round) {
    wide = Bisect(wide, EffortOf(round));
    // Draws at random may find what the local searches have missed.
    const double less = Less(wide, 1.0 - 2.0 * kSearched);
    if (HasExactWindows(problem_) || IsEmptyAt(less) || !HasMember(less, Effort::kThorough)) break;
    wide = Nearer(less);
  }
  return wide;
}

std::optional<double> ChangeSearch::NearestOfDatum() {
  const bool exact = HasExactWindows(problem_);
  if (!exact) LeastViolated();
  const std::optional<Member> start = member_;
  double before = 0.0;
  for (double step = exact ? 1e-5 : 1e-3; step < 1.0; step *= exact ? 1.05 : 1.5) {
    std::optional<double> nearest;
    for (const double sign : {1.0, -1.0}) {
      member_ = start;
      if (!HasMember(Displaced(sign * step), Effort::kQuick)) continue;
      const double found = EdgeOfDatum(sign, before, step);
      if (!nearest || std::abs(found - value_) < std::abs(*nearest - value_)) nearest = found;
    }
    if (nearest) return nearest;
    before = step;
  }
  return std::nullopt;
}

std::optional<Member> ChangeSearch::MemberAt(double value) const {
  return FindMemberFrom(Changed(problem_, target_, value), Starts(), true);
}

bool ChangeSearch::IsEmptyAt(double value) const {
  const FamilyProblem at = Changed(problem_, target_, value);
  if (HasExactWindows(at)) return !FeasibleWindows(MakeWindowProblem(at, 0.0));
  return IsProvedEmpty(at, ProofCells(at));
}

double ChangeSearch::Off() const { return GrowsUpwards(target_) ? kInfinity : 0.0; }

std::vector<Member> ChangeSearch::Starts() const {
  std::vector<Member> starts;
  if (member_) starts.push_back(*member_);
  const std::span<const Member> last = LastOf(known_);
  starts.insert(starts.end(), last.begin(), last.end());
  return starts;
}

double ChangeSearch::Nearer(double value) const {
  if (!member_ || HasExactWindows(problem_)) return value;
  const double passed = ValuePassed(problem_, target_, *member_);
  return std::abs(passed - value_) < std::abs(value - value_) &&
                 (passed > value_) == (value > value_)
             ? passed
             : value;
}

double ChangeSearch::EdgeOfDatum(double sign, double tight, double wide) {
  for (int round = 0; round < kRounds; ++round) {
    const Effort effort = EffortOf(round);
    while (wide - tight > 0.1 * kSearched * wide) {
      const double middle = 0.5 * (tight + wide);
      (HasMember(Displaced(sign * middle), effort) ? wide : tight) = middle;
    }
    const double less = (1.0 - 2.0 * kSearched) * wide;
    const double value = Displaced(sign * less);
    if (HasExactWindows(problem_) || IsEmptyAt(value) || !HasMember(value, Effort::kThorough)) {
      break;
    }
    wide = less;
    tight = 0.0;
  }
  return Displaced(sign * wide);
}

std::optional<double> ChangeSearch::WideEnough() {
  if (!GrowsUpwards(target_)) return HasMember(0.0) ? std::optional<double>(0.0) : std::nullopt;
  double wide = std::max(value_, 1e-3) * 2.0;
  for (int doubling = 0; doubling < 60; ++doubling, wide *= 2.0) {
    if (HasMember(wide)) return wide;
  }
  return std::nullopt;
}

std::optional<double> ChangeSearch::FromOff() {
  if (target_.kind == ChangeKind::kCondition) {
    ConditionSet off;
    off.Insert(target_.condition);
    if (DecideWithout(problem_, off, known_, member_) != Feasibility::kMember) {
      return std::nullopt;
    }
  }
  if (!member_) member_ = FindMemberFrom(Changed(problem_, target_, Off()), Starts(), true);
  if (!member_) return std::nullopt;
  const std::optional<double> local = NearestLocally();
  return local ? *local : ValuePassed(problem_, target_, *member_);
}

double ChangeSearch::Bisect(double wide, Effort effort) {
  // A local search mostly ends at the edge; then one evaluation suffices.
  double tight = Less(wide, 1.0 - kSearched);
  if (HasMember(tight, effort)) {
    wide = Nearer(tight);
    tight = value_;
  }
  const double precision = HasExactWindows(problem_) ? kExact : 0.5 * kSearched;
  while (std::abs(wide - tight) > precision * std::abs(wide - value_)) {
    const double middle = 0.5 * (tight + wide);
    if (middle == tight || middle == wide) break;
    if (HasMember(middle, effort)) {
      wide = Nearer(middle);
      // A member at a value where a search had found none shows that the search had missed it.
      if (std::abs(wide - value_) <= std::abs(tight - value_)) tight = value_;
    } else {
      tight = middle;
    }
  }
  return wide;
}

std::optional<double> ChangeSearch::NearestLocally() {
  if (target_.kind != ChangeKind::kCondition || IsLeast(target_.condition)) return std::nullopt;
  const LocalSearch search(problem_);
  if (!search.IsSupported()) return std::nullopt;
  const FamilyProblem without = Changed(problem_, target_, Off());
  const LocalSearch search_without(without);
  ConditionSet soft;
  soft.Insert(target_.condition);
  std::vector<Member> starts{*member_};
  for (const Member& candidate : known_) {
    if (starts.size() < 4 && Holds(without, candidate)) starts.push_back(candidate);
  }
  std::optional<double> nearest;
  for (const Member& start : starts) {
    const std::optional<LocalSolution> inside = search_without.ReduceViolation(start);
    if (!inside || !Holds(without, inside->member)) continue;
    const std::optional<LocalSolution> solution = search.Minimise(inside->member, soft);
    if (!solution || !Holds(without, solution->member)) continue;
    const double passed = ValuePassed(problem_, target_, solution->member);
    if (nearest && std::abs(passed - value_) >= std::abs(*nearest - value_)) continue;
    nearest = passed;
    member_ = solution->member;
  }
  return nearest;
}

void ChangeSearch::LeastViolated() {
  const LocalSearch search(problem_);
  if (!search.IsSupported()) return;
  double least = kInfinity;
  const auto try_start = [&](const std::optional<Member>& start) {
    if (!start) return;
    const std::optional<LocalSolution> solution = search.ReduceViolation(*start);
    if (!solution || solution->violation >= least) return;
    least = solution->violation;
    member_ = solution->member;
  };
  if (problem_.HasTransfer()) try_start(search.FromTransfer());
  for (const double xi : {0.1, 0.03}) try_start(search.Nominal(xi, 0.2));
}

double ChangeSearch::Displaced(double share) const {
  if (target_.datum == Datum::kPhase) return value_ + 90.0 * share;
  return share >= 0.0 ? value_ * (1.0 + share) : value_ / (1.0 - share);
}

}  // namespace howl
