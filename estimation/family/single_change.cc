#include "estimation/family/single_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>

#include "estimation/family/feasible.h"
#include "estimation/family/limits.h"
#include "estimation/family/local_search.h"
#include "estimation/family/proof.h"
#include "estimation/family/window.h"
#include "estimation/family/without.h"

namespace howl {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of the change: how near to v* a search comes, and how far beyond it `pasted` may lie.
constexpr double kSearched = 1e-3;
constexpr Range kBeyond{1e-3, 8e-3};
constexpr double kLess = 0.99;
constexpr double kExact = 1e-9;     // the same where exact windows decide
constexpr int kRounds = 3;          // of bisection and draws
constexpr std::size_t kStarts = 3;  // of a local search, from members of related families

double* BoundOf(FamilyProblem& problem, const ChangeTarget& target) {
  Range& range = problem.domain[target.parameter];
  return target.is_upper ? &range.hi : &range.lo;
}

double* DatumOf(FamilyProblem& problem, const ChangeTarget& target) {
  Experiment& experiment = problem.experiments[target.experiment];
  switch (target.datum) {
    case Datum::kFrequency:
      return &experiment.frequency_hz;
    case Datum::kPhase:
      return &experiment.phase_deg;
    case Datum::kGain:
      return &experiment.gain;
    case Datum::kFlameSlope:
      return experiment.flame_slope ? &*experiment.flame_slope : nullptr;
    case Datum::kReliable:
      break;
  }
  return nullptr;
}

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

// The members that passed most conditions come last.
std::span<const Member> LastOf(std::span<const Member> known) {
  return known.last(std::min(kStarts, known.size()));
}

bool GrowsUpwards(const ChangeTarget& target) {
  return target.kind == ChangeKind::kCondition ? !IsLeast(target.condition) : target.is_upper;
}

// Of a search for a member: from the member found last, from more starts, with draws at random.
enum class Effort { kQuick, kUsual, kThorough };

// More where the last round's search had missed a member.
Effort EffortOf(int round) {
  return round == 0 ? Effort::kQuick : (round == 1 ? Effort::kUsual : Effort::kThorough);
}

// One target's search: the problem as a function of the value, and the member found last.
class Search {
 public:
  Search(const FamilyProblem& problem, const ChangeTarget& target, std::span<const Member> known)
      : problem_(problem), target_(target), known_(known), value_(ValueNow(problem, target)) {}

  // Whether the family has a member at the value. Keeps the member, but exact windows decide
  // without one.
  bool HasMember(double value, Effort effort = Effort::kUsual) {
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

  // Of a limit or a bound: the nearest value that has a member, from `off`, which has one.
  std::optional<double> NearestOfMonotone() {
    const std::optional<double> reached = HasExactWindows(problem_) ? WideEnough() : FromOff();
    if (!reached) return std::nullopt;
    double wide = *reached;
    for (int round = 0; round < kRounds; ++round) {
      wide = Bisect(wide, EffortOf(round));
      // Draws at random may find what the local searches have missed.
      const double less = Less(wide, 1.0 - 2.0 * kSearched);
      if (HasExactWindows(problem_) || IsEmptyAt(less) || !HasMember(less, Effort::kThorough))
        break;
      wide = Nearer(less);
    }
    return wide;
  }

  // Of a datum: outwards to both sides until either has a member, then back to the edge.
  std::optional<double> NearestOfDatum() {
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

  std::optional<Member> MemberAt(double value) const {
    return FindMemberFrom(Changed(problem_, target_, value), Starts(), true);
  }

  bool IsEmptyAt(double value) const {
    const FamilyProblem at = Changed(problem_, target_, value);
    if (HasExactWindows(at)) return !FeasibleWindows(MakeWindowProblem(at, 0.0));
    return IsProvedEmpty(at, ProofCells(at));
  }

  // A value for "as good as none", that the search for members can work with.
  double Off() const { return GrowsUpwards(target_) ? kInfinity : 0.0; }

 private:
  std::vector<Member> Starts() const {
    std::vector<Member> starts;
    if (member_) starts.push_back(*member_);
    const std::span<const Member> last = LastOf(known_);
    starts.insert(starts.end(), last.begin(), last.end());
    return starts;
  }

  double Less(double value, double share) const { return value_ + share * (value - value_); }

  // What the member found at the value would pass, where that is nearer still.
  double Nearer(double value) const {
    if (!member_ || HasExactWindows(problem_)) return value;
    const double passed = ValuePassed(problem_, target_, *member_);
    return std::abs(passed - value_) < std::abs(value - value_) &&
                   (passed > value_) == (value > value_)
               ? passed
               : value;
  }

  // The nearest displacement between the two shares of the datum, of which the larger has a member.
  double EdgeOfDatum(double sign, double tight, double wide) {
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

  // The first of ever wider values that has a member, by exact windows.
  std::optional<double> WideEnough() {
    if (!GrowsUpwards(target_)) return HasMember(0.0) ? std::optional<double>(0.0) : std::nullopt;
    double wide = std::max(value_, 1e-3) * 2.0;
    for (int doubling = 0; doubling < 60; ++doubling, wide *= 2.0) {
      if (HasMember(wide)) return wide;
    }
    return std::nullopt;
  }

  // What a member without the limit or bound would pass, or what a local search makes of it.
  std::optional<double> FromOff() {
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

  // Between too tight and wide enough.
  double Bisect(double wide, Effort effort) {
    // A local search mostly ends at the edge: then one look suffices.
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
        // A member short of where a search had found none: that search had missed it.
        if (std::abs(wide - value_) <= std::abs(tight - value_)) tight = value_;
      } else {
        tight = middle;
      }
    }
    return wide;
  }

  // The least violation of the one condition that local searches reach from members of the family
  // without it. The search has no row for the least loop gain, which is a bound of its own.
  std::optional<double> NearestLocally() {
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
      const std::optional<Approach> inside = search_without.FindMember(start);
      if (!inside || !Holds(without, inside->member)) continue;
      const std::optional<Approach> approach = search.Minimise(inside->member, soft);
      if (!approach || !Holds(without, approach->member)) continue;
      const double passed = ValuePassed(problem_, target_, approach->member);
      if (nearest && std::abs(passed - value_) >= std::abs(*nearest - value_)) continue;
      nearest = passed;
      member_ = approach->member;
    }
    return nearest;
  }

  // The model that comes nearest to being a member, as a start for the changed problems.
  void LeastViolated() {
    const LocalSearch search(problem_);
    if (!search.IsSupported()) return;
    double least = kInfinity;
    const auto try_start = [&](const std::optional<Member>& start) {
      if (!start) return;
      const std::optional<Approach> approach = search.FindMember(*start);
      if (!approach || approach->violation >= least) return;
      least = approach->violation;
      member_ = approach->member;
    };
    if (problem_.HasTransfer()) try_start(search.FromTransfer());
    for (const double xi : {0.1, 0.03}) try_start(search.Nominal(xi, 0.2));
  }

  // A datum moved by a share of its size; degrees by a share of a quarter turn.
  double Displaced(double share) const {
    if (target_.datum == Datum::kPhase) return value_ + 90.0 * share;
    return share >= 0.0 ? value_ * (1.0 + share) : value_ / (1.0 - share);
  }

  const FamilyProblem& problem_;
  const ChangeTarget target_;
  const std::span<const Member> known_;
  const double value_;
  std::optional<Member> member_;
};

// Whether any change of the experiment's data can help: not where the others have no member.
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

void Finish(Search& search, SmallestChange& change) {
  const double by = *change.needed - change.value;
  // A number of few digits first, v* as it is where that has no member.
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

std::string_view DatumName(Datum datum) {
  constexpr std::array<std::string_view, 5> kDatumNames = {"frequency_hz", "phase_deg", "gain",
                                                           "flame_slope", "reliable"};
  return kDatumNames[static_cast<std::size_t>(datum)];
}

std::vector<ChangeTarget> ChangeTargets(const FamilyProblem& problem) {
  std::vector<ChangeTarget> targets;
  for (const Condition condition : kConditions) {
    if (Binds(problem, condition)) {
      targets.push_back({.kind = ChangeKind::kCondition, .condition = condition});
    }
  }
  for (const ParameterKind kind : kParameterKinds) {
    if (!problem.model.Uses(kind) || problem.model[kind].fixed) continue;
    for (const bool is_upper : {false, true}) {
      const Range range = problem.domain[kind];
      if (is_upper ? !std::isfinite(range.hi) : !(range.lo > 0.0)) continue;
      targets.push_back({.kind = ChangeKind::kBound, .parameter = kind, .is_upper = is_upper});
    }
  }
  const bool looks_at_slope = Binds(problem, Condition::kLoopGain);
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    const auto add = [&](Datum datum) {
      targets.push_back({.kind = ChangeKind::kDatum, .experiment = i, .datum = datum});
    };
    add(Datum::kFrequency);
    if (Binds(problem, Condition::kPhase)) add(Datum::kPhase);
    if (Binds(problem, Condition::kGain)) add(Datum::kGain);
    const Experiment& experiment = problem.experiments[i];
    if (!looks_at_slope || !experiment.reliable || !experiment.flame_slope) continue;
    if (*experiment.flame_slope != 0.0) add(Datum::kFlameSlope);
    add(Datum::kReliable);
  }
  return targets;
}

double ValueNow(const FamilyProblem& problem, const ChangeTarget& target) {
  if (target.IsSwitch()) return 1.0;
  FamilyProblem copy = problem;
  switch (target.kind) {
    case ChangeKind::kCondition:
      return *LimitOf(copy.test, target.condition);
    case ChangeKind::kBound:
      return *BoundOf(copy, target);
    case ChangeKind::kDatum:
      break;
  }
  return *DatumOf(copy, target);
}

FamilyProblem Changed(const FamilyProblem& problem, const ChangeTarget& target, double value) {
  FamilyProblem changed = problem;
  if (target.kind == ChangeKind::kCondition) {
    if (double* const limit = LimitOf(changed.test, target.condition)) {
      *limit = value;
    } else {
      changed.test.xi_increasing = value != 0.0;
    }
  } else if (target.kind == ChangeKind::kBound) {
    *BoundOf(changed, target) = value;
  } else if (target.datum == Datum::kReliable) {
    changed.experiments[target.experiment].reliable = value != 0.0;
  } else {
    *DatumOf(changed, target) = value;
  }
  return changed;
}

SmallestChange FindSmallestChange(const FamilyProblem& problem, const ChangeTarget& target,
                                  std::span<const Member> known) {
  SmallestChange change{.target = target, .value = ValueNow(problem, target)};
  Search search(problem, target, known);
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
