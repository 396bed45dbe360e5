#include "estimation/family/conflict.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "estimation/family/feasible.h"
#include "estimation/family/local_search.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double* Tolerance(MembershipTest& test, Condition condition) {
  switch (condition) {
    case Condition::kGain:
      return &test.gain_tolerance;
    case Condition::kPhase:
      return &test.phase_tolerance_deg;
    case Condition::kLoopPhase:
      return &test.loop_phase_tolerance_deg;
    case Condition::kLoopGain:
      return &test.loop_gain_min;
    case Condition::kSecondCrossing:
      return &test.second_crossing_tolerance_deg;
    case Condition::kOmegaSpread:
      return &test.omega_spread_max;
    case Condition::kXiMax:
      return &test.xi_max;
    case Condition::kXiIncreasing:
      return nullptr;
    case Condition::kTransfer:
      return &test.transfer_distance_max;
    case Condition::kSecondModeShare:
      return &test.second_mode_share_max;
    case Condition::kSecondCrossingGain:
      return &test.second_crossing_gain_min;
  }
  return nullptr;
}

// What the condition asks for is a least value: it gives way downwards.
bool IsMinimum(Condition condition) {
  return condition == Condition::kLoopGain || condition == Condition::kSecondCrossingGain;
}

void SwitchOff(MembershipTest& test, Condition condition) {
  if (double* const value = Tolerance(test, condition)) {
    *value = IsMinimum(condition) ? 0.0 : kInfinity;
  } else {
    test.xi_increasing = false;
  }
}

// A search draws best within tolerances of a moderate size, and a member at those is one without
// them: they stand for "switched off", from narrow to wide, before the real thing.
constexpr MembershipTest kModerate[] = {
    {0.1, 3.0, 6.0, 0.0, 30.0, 0.4, 0.5, false, 8.0, 0.3, 0.0},
    {0.3, 10.0, 30.0, 0.0, 90.0, 0.6, 0.8, false, 20.0, 1.0, 0.0},
    {0.6, 30.0, 90.0, 0.0, 180.0, 1.5, 1.0, false, kInfinity, kInfinity, 0.0}};

void Widen(MembershipTest& test, Condition condition, const MembershipTest& to) {
  MembershipTest wide = to;
  double* const value = Tolerance(test, condition);
  const double* const target = Tolerance(wide, condition);
  if (value == nullptr || target == nullptr) {
    test.xi_increasing = false;
  } else if (IsMinimum(condition)) {
    *value = 0.0;
  } else {
    *value = std::max(*value, *target);
  }
}

// The problem with only the conditions in `kept`. A member that was found is told.
Feasibility DecideWith(const FamilyProblem& problem, unsigned kept,
                       const std::vector<Member>& known, std::optional<Member>& member) {
  FamilyProblem at = problem;
  const auto each_other = [&](const auto& change) {
    for (std::size_t k = 0; k < kNumConditions; ++k) {
      if (!((kept >> k) & 1u)) change(kConditions[k]);
    }
  };
  each_other([&](Condition condition) { SwitchOff(at.test, condition); });
  if (HasExactWindows(at)) return DecideFeasible(at);
  for (const Member& candidate : known) {
    if (Holds(at, candidate)) return Feasibility::kMember;
  }
  if (LocalSearch(at).IsSupported()) {
    member = FindMemberLocally(at);
    return member ? Feasibility::kMember : DecideFeasible(at, false);
  }
  for (const MembershipTest& level : kModerate) {
    FamilyProblem moderate = problem;
    each_other([&](Condition condition) { Widen(moderate.test, condition, level); });
    member = FindMember(moderate);
    if (member) return Feasibility::kMember;
  }
  return DecideFeasible(at);
}

// The least violation of the one condition that a local search reaches from a member of the family
// without it, as the value that the test would have to ask for.
std::optional<double> NeededLocally(const FamilyProblem& problem, Condition condition,
                                    const Member& start) {
  if (condition == Condition::kLoopGain) return std::nullopt;  // a bound of the search's own
  FamilyProblem without = problem;
  SwitchOff(without.test, condition);
  const auto inside = LocalSearch(without).FindMember(start);
  ConditionSet soft;
  soft.Insert(condition);
  const auto nearest =
      inside ? LocalSearch(problem).Minimise(inside->member, soft) : std::optional<Approach>();
  if (!nearest) return std::nullopt;
  FamilyProblem relaxed = problem;
  double* const value = Tolerance(relaxed.test, condition);
  const double share = nearest->violation * (1.0 + 1e-6);
  if (condition == Condition::kOmegaSpread) {
    *value = std::expm1(share * std::log1p(*value));
  } else if (condition == Condition::kXiMax) {
    *value *= std::exp(share - 1.0);
  } else if (condition == Condition::kSecondCrossingGain) {
    *value *= std::exp(1.0 - share);
  } else {
    *value *= share;
  }
  if (!Holds(relaxed, nearest->member)) return std::nullopt;
  return *value;
}

Relaxation Relax(const FamilyProblem& problem, Condition condition, bool searching,
                 const std::vector<Member>& known) {
  Relaxation relaxation{.condition = condition, .value = 1.0, .needed = std::nullopt};
  FamilyProblem at = problem;
  double* const value = Tolerance(at.test, condition);
  if (value != nullptr) relaxation.value = *value;
  std::optional<Member> member;
  const unsigned others = ~(1u << static_cast<unsigned>(condition));
  relaxation.suffices = DecideWith(problem, others, known, member) == Feasibility::kMember;
  if (value == nullptr) return relaxation;
  if (!relaxation.suffices) return relaxation;
  if (searching && member) {
    relaxation.needed = NeededLocally(problem, condition, *member);
    if (relaxation.needed) return relaxation;
  }
  // The family only grows with a tolerance: bisection between too tight and wide enough.
  double tight = relaxation.value;
  double wide = IsMinimum(condition) ? 0.0 : std::max(tight, 1e-3) * 2.0;
  for (int doubling = 0; !IsMinimum(condition) && doubling < 40; ++doubling) {
    *value = wide;
    if (DecideFeasible(at) == Feasibility::kMember) break;
    tight = wide;
    wide *= 2.0;
  }
  const double precision = searching ? 1e-3 : 1e-12;
  while (std::abs(wide - tight) > precision * std::max(std::abs(wide), std::abs(tight))) {
    const double middle = 0.5 * (tight + wide);
    *value = middle;
    (DecideFeasible(at) == Feasibility::kMember ? wide : tight) = middle;
  }
  relaxation.needed = wide;
  return relaxation;
}

// The conditions that no model of this problem can fail: they are in no minimal set.
unsigned InertConditions(const FamilyProblem& problem) {
  const auto bit = [](Condition condition) { return 1u << static_cast<unsigned>(condition); };
  const auto any = [&](const auto& is_so) {
    return std::ranges::any_of(problem.experiments, is_so);
  };
  const bool two_modes = problem.model.modes == 2;
  unsigned inert = 0;
  if (!problem.HasTransfer()) inert |= bit(Condition::kTransfer);
  if (!two_modes) inert |= bit(Condition::kSecondModeShare);
  if (!two_modes || !any([](const Experiment& e) { return !e.lines.empty(); })) {
    inert |= bit(Condition::kSecondCrossing);
  }
  if (!two_modes || !any([&](const Experiment& e) { return TestsLineGain(e, problem.test); })) {
    inert |= bit(Condition::kSecondCrossingGain);
  }
  return inert;
}

}  // namespace

MembershipTest KeepConditions(const MembershipTest& test, const ConditionSet& kept) {
  MembershipTest result = test;
  for (const Condition condition : kConditions) {
    if (!kept.Contains(condition)) SwitchOff(result, condition);
  }
  return result;
}

Conflict ExplainEmpty(const FamilyProblem& problem, int threads) {
  Conflict conflict;
  const Feasibility whole = DecideFeasible(problem);
  conflict.is_empty = whole != Feasibility::kMember;
  conflict.proved = whole == Feasibility::kEmpty;
  if (!conflict.is_empty) return conflict;

  const unsigned inert = InertConditions(problem);
  std::vector<unsigned> minimal;
  std::vector<Member> known;  // found so far, to be tried first
  for (int size = 0; size <= static_cast<int>(kNumConditions); ++size) {
    std::vector<unsigned> candidates;
    for (unsigned set = 0; set < (1u << kNumConditions); ++set) {
      if (std::popcount(set) != size) continue;
      if ((set & inert) != 0) continue;
      const bool contains_smaller =
          std::any_of(minimal.begin(), minimal.end(),
                      [&](unsigned smaller) { return (set & smaller) == smaller; });
      if (!contains_smaller) candidates.push_back(set);
    }
    std::vector<Feasibility> answers(candidates.size());
    std::vector<std::optional<Member>> found(candidates.size());
    RunUnits(candidates.size(), threads, [&](std::size_t k) {
      answers[k] = DecideWith(problem, candidates[k], known, found[k]);
    });
    for (const std::optional<Member>& member : found) {
      if (member) known.push_back(*member);
    }
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (answers[k] == Feasibility::kMember) continue;
      conflict.proved &= answers[k] == Feasibility::kEmpty;
      minimal.push_back(candidates[k]);
    }
  }
  unsigned in_all = ~0u;
  for (const unsigned set : minimal) {
    in_all &= set;
    std::vector<Condition> names;
    for (std::size_t k = 0; k < kNumConditions; ++k) {
      if ((set >> k) & 1u) names.push_back(kConditions[k]);
    }
    conflict.minimal_sets.push_back(std::move(names));
  }
  for (std::size_t k = 0; k < kNumConditions && !minimal.empty(); ++k) {
    if ((in_all >> k) & 1u) {
      conflict.relaxations.push_back(
          Relax(problem, kConditions[k], whole == Feasibility::kNotFound, known));
    }
  }
  return conflict;
}

std::vector<std::string_view> ConflictNames(const Conflict& conflict) {
  std::vector<std::string_view> names;
  for (const Condition condition : kConditions) {
    for (const std::vector<Condition>& set : conflict.minimal_sets) {
      if (std::find(set.begin(), set.end(), condition) != set.end()) {
        names.push_back(ConditionName(condition));
        break;
      }
    }
  }
  return names;
}

}  // namespace howl
