// The limits of a test's conditions, one by one: what a limit is, whether it binds a problem at
// all, what switches it off, and the limit that a given model would just pass.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_LIMITS_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_LIMITS_H_

#include <span>

#include "estimation/family/problem/problem.h"

namespace howl {

// In the unit of the condition's key; nullptr for a condition that has none (xi_increasing).
double* LimitOf(MembershipTest& test, Condition condition);

// A least value, not a largest one: the family grows as it falls.
bool IsLeast(Condition condition);

void SwitchOff(MembershipTest& test, Condition condition);

// The condition is on, and the problem has something that it looks at.
bool Binds(const FamilyProblem& problem, Condition condition);

// The test with only the given conditions left on.
MembershipTest KeepConditions(const MembershipTest& test, const ConditionSet& kept);

// The tightest limit of the condition that the models pass; no meaning for xi_increasing.
double LimitPassed(const FamilyProblem& problem, std::span<const LoopModel> models,
                   Condition condition);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_LIMITS_H_
