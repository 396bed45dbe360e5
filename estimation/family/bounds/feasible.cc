#include "estimation/family/bounds/feasible.h"

#include "estimation/family/bounds/proof.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/drawer/window.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/transfer_starts.h"

namespace howl {

bool HasExactWindows(const FamilyProblem& problem) {
  const auto is_free = [&](ParameterKind kind) {
    const Range range = problem.RangeOf(kind);
    return range.lo <= 0.0 && !std::isfinite(range.hi);
  };
  return problem.model.modes == 1 && problem.model.own.empty() && !problem.HasTransfer() &&
         !problem.IsShared(ParameterKind::kN) && !problem.IsShared(ParameterKind::kTau) &&
         is_free(ParameterKind::kN) && is_free(ParameterKind::kTau) &&
         is_free(ParameterKind::kOmega);
}

std::optional<Member> FindMember(const FamilyProblem& problem) {
  if (NeedsTransferStarts(problem)) {
    std::vector<Member> starts = TransferStarts(problem, 1);
    if (starts.empty()) return std::nullopt;
    return std::move(starts[0]);
  }
  // Attempts are counted by members asked for: one would be given up too soon in a thin family.
  constexpr std::size_t kAsked = 50;
  const Enumeration enumeration = EnumerateMembers(problem, kAsked, 0, 1);
  if (enumeration.members.empty()) return std::nullopt;
  return enumeration.members[0];
}

std::optional<Member> FindMemberLocally(const FamilyProblem& problem) {
  const LocalSearch search(problem);
  if (!search.IsSupported()) return std::nullopt;
  const auto inside = [&](const std::optional<Member>& start) -> std::optional<Member> {
    if (!start) return std::nullopt;
    std::optional<LocalSolution> found = search.ReduceViolation(*start);
    if (!found || !Holds(problem, found->member)) return std::nullopt;
    return std::move(found->member);
  };
  if (problem.HasTransfer()) {
    if (std::optional<Member> member = inside(search.FromTransfer())) return member;
  }
  for (const double relative : {0.2, 0.02, 1.0}) {
    for (const double xi : {0.1, 0.03, 0.25}) {
      if (std::optional<Member> member = inside(search.Nominal(xi, relative))) return member;
    }
    if (problem.model.modes == 1) break;
  }
  return std::nullopt;
}

std::optional<Member> FindMemberNear(const FamilyProblem& problem, const Member& start) {
  if (Holds(problem, start)) return start;
  std::optional<LocalSolution> found = LocalSearch(problem).ReduceViolation(start);
  if (!found || !Holds(problem, found->member)) return std::nullopt;
  return std::move(found->member);
}

std::optional<Member> FindMemberFrom(const FamilyProblem& problem, std::span<const Member> starts,
                                     bool thorough) {
  for (const Member& start : starts) {
    if (Holds(problem, start)) return start;
  }
  if (HasExactWindows(problem)) {
    if (!FeasibleWindows(MakeWindowProblem(problem, 0.0))) return std::nullopt;
    return FindMember(problem);
  }
  for (const ExperimentTarget& target : MakeTargets(problem, 0.0)) {
    if (target.IsEmpty()) return std::nullopt;
  }
  const LocalSearch search(problem);
  for (const Member& start : starts) {
    if (std::optional<Member> member = FindMemberNear(problem, start)) return member;
  }
  if (std::optional<Member> member = FindMemberLocally(problem)) return member;
  return thorough || !search.IsSupported() ? FindMember(problem) : std::nullopt;
}

Feasibility DecideFeasible(const FamilyProblem& problem, bool thorough) {
  if (HasExactWindows(problem)) {
    return FeasibleWindows(MakeWindowProblem(problem, 0.0)) ? Feasibility::kMember
                                                            : Feasibility::kEmpty;
  }
  for (const ExperimentTarget& target : MakeTargets(problem, 0.0)) {
    if (target.IsEmpty()) return Feasibility::kEmpty;
  }
  if (FindMemberLocally(problem)) return Feasibility::kMember;
  if (!thorough && LocalSearch(problem).IsSupported()) return Feasibility::kNotFound;
  if (IsProvedEmpty(problem, ProofCells(problem))) return Feasibility::kEmpty;
  if (NeedsTransferStarts(problem)) {
    return FindMember(problem) ? Feasibility::kMember : Feasibility::kNotFound;
  }
  return MemberDrawer(problem).HasSupport() ? Feasibility::kMember : Feasibility::kNotFound;
}

}  // namespace howl
