// The limits of a test's conditions, one by one: what a limit is, whether it binds a problem at
// all, what switches it off, and the limit that a given model would just pass.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_LIMITS_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_LIMITS_H_

#include <span>

#include "estimation/family/problem/problem.h"

namespace howl {

// The limit in the unit of the condition's key; nullptr for a condition that has none
// (xi_increasing).
double* LimitOf(MembershipTest& test, Condition condition);

// True for a least value instead of a largest one: the family grows as it falls.
bool IsLeast(Condition condition);

void SwitchOff(MembershipTest& test, Condition condition);

// True where the condition is on and applies to something in the problem.
bool Binds(const FamilyProblem& problem, Condition condition);

// The test with only the given conditions left on.
MembershipTest KeepConditions(const MembershipTest& test, const ConditionSet& kept);

// The tightest limit of the condition that the models pass; no meaning for xi_increasing.
double LimitPassed(const FamilyProblem& problem, std::span<const LoopModel> models,
                   Condition condition);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_LIMITS_H_
