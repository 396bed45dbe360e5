// Whether the family without some of its test's conditions has a member, and which.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_WITHOUT_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_WITHOUT_H_

#include <optional>
#include <span>

#include "estimation/family/bounds/feasible.h"
#include "estimation/family/problem/problem.h"

namespace howl {

// `known`: members of related families, tried before any search. `member`: one of those, or what a
// search found; exact windows decide without any.
Feasibility DecideWithout(const FamilyProblem& problem, const ConditionSet& off,
                          std::span<const Member> known, std::optional<Member>& member);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_WITHOUT_H_
