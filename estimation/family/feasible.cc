#include "estimation/family/feasible.h"

#include "estimation/family/enumerate.h"
#include "estimation/family/transfer_starts.h"
#include "estimation/family/window.h"

namespace howl {

bool HasExactWindows(const FamilyProblem& problem) {
  const auto is_free = [&](ParameterKind kind) {
    const Range range = problem.RangeOf(kind);
    return range.lo <= 0.0 && !std::isfinite(range.hi);
  };
  return problem.model.modes == 1 && !problem.HasTransfer() && !problem.IsShared(ParameterKind::kN) &&
         !problem.IsShared(ParameterKind::kTau) && is_free(ParameterKind::kN) &&
         is_free(ParameterKind::kTau) && is_free(ParameterKind::kOmega);
}

std::optional<Member> FindMember(const FamilyProblem& problem) {
  if (NeedsTransferStarts(problem)) {
    std::vector<Member> starts = TransferStarts(problem, 1);
    if (starts.empty()) return std::nullopt;
    return std::move(starts[0]);
  }
  const Enumeration enumeration = EnumerateMembers(problem, 1, 0, 1);
  if (enumeration.members.empty()) return std::nullopt;
  return enumeration.members[0];
}

Feasibility DecideFeasible(const FamilyProblem& problem) {
  if (HasExactWindows(problem)) {
    return FeasibleWindows(MakeWindowProblem(problem, 0.0)) ? Feasibility::kMember
                                                            : Feasibility::kEmpty;
  }
  for (const ExperimentTarget& target : MakeTargets(problem, 0.0)) {
    if (target.IsEmpty()) return Feasibility::kEmpty;
  }
  if (NeedsTransferStarts(problem)) {
    return FindMember(problem) ? Feasibility::kMember : Feasibility::kNotFound;
  }
  return MemberDrawer(problem).HasSupport() ? Feasibility::kMember : Feasibility::kNotFound;
}

}  // namespace howl
