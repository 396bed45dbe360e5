#include "estimation/family/members/transfer_starts.h"

#include "estimation/family/local/local_search.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/problem/random.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

std::optional<Member> FirstMember(const FamilyProblem& problem, const LocalSearch& search) {
  constexpr std::size_t kTried = 8;
  const auto inside = [&](const Member& start) -> std::optional<Member> {
    std::optional<Approach> approach = search.FindMember(start, 0.9);
    if (!approach || !Holds(problem, approach->member)) return std::nullopt;
    return std::move(approach->member);
  };
  if (const std::optional<Member> centre = search.FromTransfer()) {
    if (std::optional<Member> member = inside(*centre)) return member;
  }
  FamilyProblem without = problem;
  without.test.transfer_distance_max = std::numeric_limits<double>::infinity();
  for (const Member& start : EnumerateMembers(without, kTried, 0, 1).members) {
    if (std::optional<Member> member = inside(start)) return member;
  }
  return std::nullopt;
}

}  // namespace

bool NeedsTransferStarts(const FamilyProblem& problem) {
  return problem.HasTransfer() && LocalSearch(problem).IsSupported();
}

std::vector<Member> TransferStarts(const FamilyProblem& problem, std::size_t count,
                                   std::uint64_t seed, int threads) {
  const LocalSearch search(problem);
  const std::optional<Member> first =
      search.IsSupported() ? FirstMember(problem, search) : std::nullopt;
  if (!first) return {};
  std::vector<Member> members(std::max<std::size_t>(count, 1), *first);
  RunUnits(members.size(), threads, [&](std::size_t k) {
    if (k == 0) return;
    UnitRandom random(seed, 0x300000 + k);
    const std::size_t i = random.Index(problem.experiments.size());
    const std::size_t which = random.Index(4);
    const MemberQuantity quantity{[i, which](std::span<const LoopModel> models) {
                                    const LoopModel& m = models[i];
                                    return std::log(which == 0   ? m.omega_hz
                                                    : which == 1 ? m.xi
                                                    : which == 2 ? m.N
                                                                 : (m.M > 0.0 ? m.M : m.tau_s));
                                  },
                                  {i}};
    const double sign = random.Uniform() < 0.5 ? -1.0 : 1.0;
    if (std::optional<Member> far = search.Farthest(*first, quantity, sign, 0.1)) {
      members[k] = *std::move(far);
    }
  });
  return members;
}

}  // namespace howl
