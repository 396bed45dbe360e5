// Why a family is empty: the minimal sets of conditions of the test that no model fulfils together
// (drop any one of a set and its others have a common member), and the smallest change of each
// single limit, bound or datum that gives the family a member.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_CONFLICT_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_CONFLICT_H_

#include <string_view>
#include <vector>

#include "estimation/family/answers/conflict/limits.h"
#include "estimation/family/answers/conflict/single_change.h"
#include "estimation/family/problem/problem.h"

namespace howl {

struct Conflict {
  bool is_empty = false;
  bool proved = false;  // false: a search found no member
  Member member;        // where the family is not empty
  // By increasing size. An empty set: the bounds of the parameters exclude each other.
  std::vector<std::vector<Condition>> minimal_sets;
  std::vector<bool> sets_proved;  // of each
  // The changes of every limit that binds, bound that was given and datum that the test looks at.
  std::vector<SmallestChange> changes;
};

// Sets of all conditions are tried from the smallest. `threads` as in RunUnits.
Conflict ExplainEmpty(const FamilyProblem& problem, int threads = 1);

// The names of the conditions in all minimal sets, each once: the `empty_because` of a result.
std::vector<std::string_view> ConflictNames(const Conflict& conflict);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_CONFLICT_H_
