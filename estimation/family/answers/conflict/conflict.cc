#include "estimation/family/answers/conflict/conflict.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "estimation/family/answers/conflict/without.h"
#include "estimation/family/bounds/feasible.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

using ConditionBits = unsigned;

bool Has(ConditionBits set, Condition condition) {
  return (set >> static_cast<unsigned>(condition)) & 1u;
}

// Sets of binding conditions, of that size, that hold no smaller minimal set.
std::vector<ConditionBits> Candidates(int size, ConditionBits binding,
                                      const std::vector<ConditionBits>& minimal) {
  std::vector<ConditionBits> candidates;
  for (ConditionBits set = 0; set < (1u << kNumConditions); ++set) {
    if (std::popcount(set) != size || (set & ~binding) != 0) continue;
    const bool contains_smaller =
        std::any_of(minimal.begin(), minimal.end(),
                    [&](ConditionBits smaller) { return (set & smaller) == smaller; });
    if (!contains_smaller) candidates.push_back(set);
  }
  return candidates;
}

ConditionSet Others(ConditionBits kept) {
  ConditionSet off;
  for (const Condition condition : kConditions) {
    if (!Has(kept, condition)) off.Insert(condition);
  }
  return off;
}

void FindMinimalSets(const FamilyProblem& problem, int threads, std::vector<Member>& known,
                     Conflict& conflict) {
  ConditionBits binding = 0;
  for (const Condition condition : kConditions) {
    if (Binds(problem, condition)) binding |= 1u << static_cast<unsigned>(condition);
  }
  std::vector<ConditionBits> minimal;
  for (int size = 0; size <= std::popcount(binding); ++size) {
    const std::vector<ConditionBits> candidates = Candidates(size, binding, minimal);
    std::vector<Feasibility> answers(candidates.size());
    std::vector<std::optional<Member>> found(candidates.size());
    RunUnits(candidates.size(), threads, [&](std::size_t k) {
      answers[k] = DecideWithout(problem, Others(candidates[k]), known, found[k]);
    });
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (found[k]) known.push_back(*found[k]);
      if (answers[k] == Feasibility::kMember) continue;
      minimal.push_back(candidates[k]);
      conflict.sets_proved.push_back(answers[k] == Feasibility::kEmpty);
    }
  }
  for (const ConditionBits set : minimal) {
    std::vector<Condition> names;
    for (const Condition condition : kConditions) {
      if (Has(set, condition)) names.push_back(condition);
    }
    conflict.minimal_sets.push_back(std::move(names));
  }
}

// The change of a limit can only help if the limit is in every minimal set.
bool IsInAll(const Conflict& conflict, Condition condition) {
  return std::all_of(conflict.minimal_sets.begin(), conflict.minimal_sets.end(),
                     [&](const std::vector<Condition>& set) {
                       return std::find(set.begin(), set.end(), condition) != set.end();
                     });
}

}  // namespace

Conflict ExplainEmpty(const FamilyProblem& problem, int threads) {
  Conflict conflict;
  const Feasibility whole = DecideFeasible(problem);
  conflict.is_empty = whole != Feasibility::kMember;
  if (!conflict.is_empty) {
    if (std::optional<Member> member = FindMemberFrom(problem, {}, true)) {
      conflict.member = *std::move(member);
    }
    return conflict;
  }
  std::vector<Member> known;
  FindMinimalSets(problem, threads, known, conflict);
  // A proof that some of the conditions exclude each other is a proof that all do.
  conflict.proved = whole == Feasibility::kEmpty ||
                    std::find(conflict.sets_proved.begin(), conflict.sets_proved.end(), true) !=
                        conflict.sets_proved.end();
  const std::vector<ChangeTarget> targets = ChangeTargets(problem);
  conflict.changes.resize(targets.size());
  RunUnits(targets.size(), threads, [&](std::size_t k) {
    const ChangeTarget& target = targets[k];
    if (target.kind == ChangeKind::kCondition && !IsInAll(conflict, target.condition)) {
      conflict.changes[k] = {.target = target, .value = ValueNow(problem, target)};
      return;
    }
    conflict.changes[k] = FindSmallestChange(problem, target, known);
  });
  if (conflict.proved) return conflict;
  // A set that a search called empty without proof may have a member after all, near one of the
  // members that were found since.
  for (const SmallestChange& change : conflict.changes) {
    if (!change.helps) continue;
    std::optional<Member> member = FindMemberNear(problem, change.member);
    if (!member) continue;
    Conflict none;
    none.member = *std::move(member);
    return none;
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
