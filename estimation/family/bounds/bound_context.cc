#include "estimation/family/bounds/bound_context.h"

#include <utility>

#include "estimation/family/bounds/feasible.h"
#include "estimation/family/members/transfer_starts.h"
#include "estimation/family/members/two_mode_tradeoff.h"

namespace howl {

namespace {

constexpr std::size_t kBaseMembers = 1000;

}  // namespace

BoundContext::BoundContext(const FamilyProblem& family, std::uint64_t seed_of_draws)
    : problem(family),
      seed(seed_of_draws),
      contractor(family),
      local(family),
      root(contractor.Root()),
      root_empty(!contractor.Contract(root)) {
  if (!NeedsTransferStarts(problem)) drawer = std::make_unique<MemberDrawer>(problem);
  base = (drawer ? EnumerateMembers(problem, *drawer, kBaseMembers, seed)
                 : EnumerateMembers(problem, kBaseMembers, seed))
             .members;
  // The family may be too thin for draws at random to meet.
  if (base.empty() && !root_empty) {
    if (std::optional<Member> member = FindMemberLocally(problem)) base.push_back(*member);
  }
  if (HasGreedyTradeoff(problem)) {
    for (Member& member : ExtremeMembers(problem)) base.push_back(std::move(member));
  }
}

}  // namespace howl
