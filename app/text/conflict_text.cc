#include "app/text/conflict_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/text/text_table.h"
#include "io/results/family/family_changes.h"

namespace howl {
namespace {

constexpr std::size_t kShownData = 12;

void PrintSets(const Conflict& conflict) {
  std::printf("the family is empty%s\n",
              conflict.proved ? " (proved)" : " as far as the search went; this is not a proof");
  for (std::size_t k = 0; k < conflict.minimal_sets.size(); ++k) {
    std::vector<std::string> names;
    for (const Condition condition : conflict.minimal_sets[k]) {
      names.emplace_back(ConditionName(condition));
    }
    if (names.empty()) names = {"the bounds of the parameters and the data themselves"};
    std::printf("  exclude each other%s: %s\n",
                conflict.sets_proved[k] ? "" : ", as far as the search went",
                CommaSeparated(names).c_str());
  }
}

// The change relative to the present value.
double Size(const SmallestChange& change) {
  if (change.target.IsSwitch() || change.value == 0.0) return 1.0;
  return std::abs(*change.pasted / change.value - 1.0);
}

void PrintHelp(const FamilyProblem& problem, const SmallestChange& change,
               std::span<const std::string> recorded) {
  const std::string line = ChangeLine(problem, change, recorded);
  const std::string now = change.target.IsSwitch() ? "true" : Significant(change.value);
  if (!line.empty()) {
    std::printf("  %s  # %s now\n", line.c_str(), now.c_str());
  } else {
    std::printf("  # %s: %s by its record, %s would do\n",
                ChangeName(problem, change.target).c_str(), now.c_str(),
                Significant(*change.pasted).c_str());
  }
}

// Conditions and bounds by name; an experiment as a whole where no datum of its own helps.
void PrintHelpless(const FamilyProblem& problem, const Conflict& conflict) {
  std::vector<std::string> names;
  std::vector<std::string> untried;
  for (const SmallestChange& change : conflict.changes) {
    if (change.helps || change.target.kind == ChangeKind::kDatum) continue;
    names.push_back(ChangeName(problem, change.target));
  }
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    std::vector<std::string> own;
    bool any_helps = false;
    bool all_searched = true;
    for (const SmallestChange& change : conflict.changes) {
      if (change.target.kind != ChangeKind::kDatum || change.target.experiment != i) continue;
      any_helps |= change.helps;
      all_searched &= change.searched;
      if (!change.helps) own.push_back(ChangeName(problem, change.target));
    }
    if (own.empty()) continue;
    if (!any_helps) own = {"any datum of " + problem.experiments[i].name};
    std::vector<std::string>& list = all_searched ? names : untried;
    list.insert(list.end(), own.begin(), own.end());
  }
  if (!names.empty()) {
    std::printf("no change of one of these alone gives a member:\n  %s\n",
                CommaSeparated(names).c_str());
  }
  if (!untried.empty()) std::printf("not tried: %s\n", CommaSeparated(untried).c_str());
}

}  // namespace

void PrintConflict(const FamilyProblem& problem, const Conflict& conflict,
                   std::span<const std::string> recorded) {
  PrintSets(conflict);
  std::vector<const SmallestChange*> limits;
  std::vector<const SmallestChange*> data;
  for (const SmallestChange& change : conflict.changes) {
    if (!change.helps) continue;
    (change.target.kind == ChangeKind::kDatum ? data : limits).push_back(&change);
  }
  std::stable_sort(data.begin(), data.end(), [](const SmallestChange* a, const SmallestChange* b) {
    return Size(*a) < Size(*b);
  });
  if (limits.empty() && data.empty()) {
    std::printf("no single change gives a member: more than one thing has to give\n");
    return;
  }
  std::printf(
      "a member was found with each of these lines alone, in place of what the config has there\n"
      "(the smallest such changes: with 1 %% less of it there was none):\n");
  for (const SmallestChange* const change : limits) PrintHelp(problem, *change, recorded);
  for (std::size_t k = 0; k < std::min(kShownData, data.size()); ++k) {
    PrintHelp(problem, *data[k], recorded);
  }
  if (data.size() > kShownData) {
    std::printf("  # %zu more data that would do are in family.json\n", data.size() - kShownData);
  }
  PrintHelpless(problem, conflict);
  const auto is_condition = [](const SmallestChange* change) {
    return change->target.kind == ChangeKind::kCondition;
  };
  if (std::ranges::any_of(limits, is_condition)) {
    std::printf(
        "to leave a condition out altogether, without touching the config: --without NAME\n");
  }
}

}  // namespace howl
