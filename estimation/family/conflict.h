// Why a family is empty: the minimal sets of conditions of the test that no model fulfils together
// (drop any one of a set and its others have a common member), and by how much each single
// condition would have to give for the family to have a member.
#ifndef HOWL_ESTIMATION_FAMILY_CONFLICT_H_
#define HOWL_ESTIMATION_FAMILY_CONFLICT_H_

#include <optional>
#include <vector>

#include "estimation/family/problem.h"

namespace howl {

struct Relaxation {
  Condition condition;
  bool suffices = false;         // dropping this condition alone gives a member
  double value = 0.0;            // what the test asks now (xi_increasing: 1)
  std::optional<double> needed;  // the nearest value that gives one; none for xi_increasing
};

struct Conflict {
  bool is_empty = false;
  // Without a proof the sets rest on a search that found no member.
  bool proved = false;
  // By increasing size.
  std::vector<std::vector<Condition>> minimal_sets;
  std::vector<Relaxation> relaxations;  // of each condition that is in every minimal set
};

// Sets of all conditions are tried from the smallest. `threads` as in RunUnits.
Conflict ExplainEmpty(const FamilyProblem& problem, int threads = 1);

// The test with only the given conditions left on.
MembershipTest KeepConditions(const MembershipTest& test, const ConditionSet& kept);

// The names over all minimal sets, each once: the `empty_because` of a result.
std::vector<std::string_view> ConflictNames(const Conflict& conflict);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_CONFLICT_H_
