#include "estimation/family/members/transfer_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "estimation/family/local/local_search.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/problem/membership.h"
#include "estimation/family/problem/random.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

constexpr double kWellInside = 0.9;  // of every tolerance, as chains like to begin

// A member found by a row of local searches. A long bent valley takes more than one: each begins
// where the last one ended, for as long as that reduces the violation.
std::optional<Member> FindMemberInSteps(const FamilyProblem& problem, const LocalSearch& search,
                                        const Member& start) {
  constexpr int kMostSearches = 40;
  constexpr double kNearer = 0.99;
  Member from = start;
  double violation = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostSearches; ++k) {
    std::optional<LocalSolution> solution = search.ReduceViolation(from, kWellInside);
    if (!solution || !(solution->violation < kNearer * violation)) return std::nullopt;
    if (Holds(problem, solution->member)) return std::move(solution->member);
    violation = solution->violation;
    from = std::move(solution->member);
  }
  return std::nullopt;
}

// A member found from one that passes the rest of the test, by shrinking the transfers' tolerance
// in steps: the ellipsoid may be too long in one direction and too thin in the others to be reached
// at once.
std::optional<Member> ByNarrowing(const FamilyProblem& problem, Member member) {
  constexpr double kStep = 0.25;
  double distance = 0.0;
  for (std::size_t i = 0; i < member.size(); ++i) {
    const double here = ComputeErrors(problem.experiments[i], member[i]).transfer_distance;
    if (std::isfinite(here)) distance = std::max(distance, here);
  }
  FamilyProblem step = problem;
  while (distance > problem.test.transfer_distance_max) {
    distance = std::max(kStep * distance, problem.test.transfer_distance_max);
    step.test.transfer_distance_max = distance;
    std::optional<Member> nearer = FindMemberInSteps(step, LocalSearch(step), member);
    if (!nearer) return std::nullopt;
    member = *std::move(nearer);
  }
  return member;
}

std::optional<Member> FirstMember(const FamilyProblem& problem, const LocalSearch& search) {
  constexpr std::size_t kTried = 8;
  if (const std::optional<Member> centre = search.FromTransfer()) {
    if (std::optional<Member> member = FindMemberInSteps(problem, search, *centre)) return member;
  }
  FamilyProblem without = problem;
  without.test.transfer_distance_max = std::numeric_limits<double>::infinity();
  const std::vector<Member> starts = EnumerateMembers(without, kTried, 0, 1).members;
  for (const Member& start : starts) {
    if (std::optional<Member> member = FindMemberInSteps(problem, search, start)) return member;
  }
  for (const Member& start : starts) {
    if (std::optional<Member> member = ByNarrowing(problem, start)) return member;
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
