#include "estimation/family/answers/conflict/without.h"

#include <algorithm>

#include "estimation/family/answers/conflict/limits.h"
#include "estimation/family/bounds/proof.h"
#include "estimation/family/local/local_search.h"
#include "model/numerics/constants.h"

namespace howl {

namespace {

// A search draws best within tolerances of a moderate size, and a member within those is a member
// without them. Such tolerances are tried in the place of "switched off", from narrow to wide,
// before the conditions are really switched off.
constexpr MembershipTest kModerate[] = {
    {0.1, 3.0, 6.0, 0.0, 30.0, 0.4, 0.5, false, 8.0, 0.3, 0.0},
    {0.3, 10.0, 30.0, 0.0, 90.0, 0.6, 0.8, false, 20.0, 1.0, 0.0},
    {0.6, 30.0, 90.0, 0.0, 180.0, 1.5, 1.0, false, kInfinity, kInfinity, 0.0}};

void Widen(MembershipTest& test, Condition condition, const MembershipTest& to) {
  MembershipTest wide = to;
  double* const limit = LimitOf(test, condition);
  if (limit == nullptr || IsLeast(condition)) {
    SwitchOff(test, condition);
  } else {
    *limit = std::max(*limit, *LimitOf(wide, condition));
  }
}

}  // namespace

Feasibility DecideWithout(const FamilyProblem& problem, const ConditionSet& off,
                          std::span<const Member> known, std::optional<Member>& member) {
  FamilyProblem at = problem;
  for (const Condition condition : kConditions) {
    if (off.Contains(condition)) SwitchOff(at.test, condition);
  }
  if (HasExactWindows(at)) return DecideFeasible(at);
  for (const Member& candidate : known) {
    if (!Holds(at, candidate)) continue;
    member = candidate;
    return Feasibility::kMember;
  }
  if (LocalSearch(at).IsSupported()) {
    member = FindMemberLocally(at);
    if (member) return Feasibility::kMember;
    return IsProvedEmpty(at, ProofCells(at)) ? Feasibility::kEmpty : Feasibility::kNotFound;
  }
  for (const MembershipTest& level : kModerate) {
    FamilyProblem moderate = problem;
    for (const Condition condition : kConditions) {
      if (off.Contains(condition)) Widen(moderate.test, condition, level);
    }
    member = FindMember(moderate);
    if (member) return Feasibility::kMember;
  }
  return DecideFeasible(at);
}

}  // namespace howl
