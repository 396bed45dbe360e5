// Whether a family has a member at all.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_FEASIBLE_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_FEASIBLE_H_

#include <optional>
#include <span>

#include "estimation/family/problem/problem.h"

namespace howl {

enum class Feasibility {
  kMember,    // a member exists
  kEmpty,     // proved that none does
  kNotFound,  // a search found none, without proof
};

// One mode without a shared N or tau and without bounds on N, tau or omega: the windows of
// estimation/family/members/drawer/window.h decide, exactly and in microseconds.
bool HasExactWindows(const FamilyProblem& problem);

// A member by draws at random, or from the transfers' centres where the test looks at transfers.
std::optional<Member> FindMember(const FamilyProblem& problem);

// A member, by a local search from the start alone, which need not be one.
std::optional<Member> FindMemberNear(const FamilyProblem& problem, const Member& start);

// A member, by the cheapest search that finds one: from the starts, which need not be members, then
// by FindMemberLocally, and by FindMember if `thorough` or where no local search can be made.
std::optional<Member> FindMemberFrom(const FamilyProblem& problem, std::span<const Member> starts,
                                     bool thorough);

// kEmpty and kMember up to rounding (1e-9 of a tolerance). Without exact windows: local searches
// from a grid of dampings and second modes, and if these find nothing and `thorough`, a proof by
// intervals that there is none, then draws at random.
Feasibility DecideFeasible(const FamilyProblem& problem, bool thorough = true);

// Decides by those local searches alone.
std::optional<Member> FindMemberLocally(const FamilyProblem& problem);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_FEASIBLE_H_
