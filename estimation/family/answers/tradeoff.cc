#include "estimation/family/answers/tradeoff.h"

#include <algorithm>
#include <cmath>

#include "estimation/family/bounds/feasible.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/drawer/window.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/transfer_starts.h"
#include "estimation/family/members/two_mode_tradeoff.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

double LargestXi(const Member& member) {
  double xi = 0.0;
  for (const LoopModel& model : member) xi = std::max(xi, model.xi);
  return xi;
}

// Lowers xi_max below the best member found until no more are found.
std::optional<double> SearchSmallestXi(FamilyProblem problem, std::uint64_t seed) {
  constexpr int kMembersPerRound = 64;
  constexpr int kRounds = 40;
  std::optional<double> best;
  problem.test.xi_max = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const Enumeration enumeration =
        EnumerateMembers(problem, kMembersPerRound, seed + static_cast<std::uint64_t>(round), 1);
    if (enumeration.members.empty()) break;
    double round_best = std::numeric_limits<double>::infinity();
    for (const Member& member : enumeration.members) {
      round_best = std::min(round_best, LargestXi(member));
    }
    const bool slow = best && round_best > *best * (1.0 - 1e-4);
    best = best ? std::min(*best, round_best) : round_best;
    problem.test.xi_max = *best;
    if (slow) break;
  }
  return best;
}

// The least largest xi that a local search reaches from members, and whether it is the same from
// all of them.
struct LocalLeast {
  std::optional<double> xi;
  bool agreed = true;
};

LocalLeast LeastXiLocally(FamilyProblem problem, const std::vector<Member>& starts) {
  constexpr double kAgreement = 1e-6;
  LocalLeast result;
  std::optional<double>& best = result.xi;
  ConditionSet soft;
  soft.Insert(Condition::kXiMax);
  problem.test.xi_max = std::numeric_limits<double>::infinity();
  const LocalSearch free(problem);
  for (const Member& start : starts) {
    const std::optional<LocalSolution> inside = free.ReduceViolation(start);
    if (!inside || !Holds(problem, inside->member)) continue;
    FamilyProblem limited = problem;
    limited.test.xi_max = 1.01 * LargestXi(inside->member);
    const std::optional<LocalSolution> least = LocalSearch(limited).Minimise(inside->member, soft);
    if (!least || !Holds(problem, least->member)) continue;
    const double xi = LargestXi(least->member);
    result.agreed &= !best || std::abs(*best - xi) < kAgreement;
    best = best ? std::min(*best, xi) : xi;
  }
  return result;
}

// Members from which local searches start, with the largest spread that is asked for.
std::vector<Member> LocalStarts(const FamilyProblem& problem, double omega_spread,
                                std::uint64_t seed) {
  constexpr std::size_t kMembersBegunWith = 6;
  FamilyProblem wide = problem;
  wide.test.omega_spread_max = std::max(omega_spread, problem.test.omega_spread_max);
  if (problem.model.modes == 1 || !LocalSearch(wide).IsSupported()) return {};
  std::vector<Member> starts = EnumerateMembers(wide, kMembersBegunWith, seed, 1).members;
  if (starts.empty()) {
    wide.test.xi_max = std::numeric_limits<double>::infinity();
    starts = EnumerateMembers(wide, kMembersBegunWith, seed, 1).members;
  }
  return starts;
}

TradeoffPoint TradeoffAt(const FamilyProblem& problem, double omega_spread, std::uint64_t seed,
                         const std::vector<Member>& starts) {
  TradeoffPoint point{omega_spread, std::nullopt, HasExactWindows(problem)};
  FamilyProblem at = problem;
  at.test.omega_spread_max = omega_spread;
  at.test.xi_max = std::numeric_limits<double>::infinity();
  if (point.exact) {
    point.xi_max = SmallestLargestXi(MakeWindowProblem(at, 0.0));
  } else if (NeedsTransferStarts(at)) {
    point.xi_max = LeastXiLocally(at, TransferStarts(at, 1, seed)).xi;
  } else if (starts.empty()) {
    point.xi_max = SearchSmallestXi(at, seed);
  } else {
    const LocalLeast local = LeastXiLocally(at, starts);
    point.xi_max = local.xi;
    if (!local.agreed && HasGreedyTradeoff(at)) {
      const std::optional<double> greedy = GreedySmallestXi(at);
      if (greedy && (!point.xi_max || *greedy < *point.xi_max)) point.xi_max = greedy;
    }
  }
  return point;
}

}  // namespace

TradeoffPoint ComputeTradeoff(const FamilyProblem& problem, double omega_spread,
                              std::uint64_t seed) {
  return TradeoffAt(problem, omega_spread, seed, LocalStarts(problem, omega_spread, seed));
}

std::vector<TradeoffPoint> ComputeTradeoff(const FamilyProblem& problem,
                                           std::span<const double> omega_spreads, int threads,
                                           std::uint64_t seed) {
  std::vector<TradeoffPoint> points(omega_spreads.size());
  if (points.empty()) return points;
  const std::vector<Member> starts =
      LocalStarts(problem, *std::ranges::max_element(omega_spreads), seed);
  RunUnits(points.size(), threads, [&](std::size_t k) {
    points[k] = TradeoffAt(problem, omega_spreads[k], seed + 1000 * k, starts);
  });
  return points;
}

std::vector<double> DefaultSpreads(const FamilyProblem& problem, std::size_t count) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = 0.0;
  for (const Experiment& experiment : problem.experiments) {
    lowest = std::min(lowest, experiment.frequency_hz);
    highest = std::max(highest, experiment.frequency_hz);
  }
  // With omega = f everywhere xi may vanish: no more spread is needed than that of f itself.
  const double largest = std::max(1.2 * (highest / lowest - 1.0), problem.test.omega_spread_max);
  const double end = std::isfinite(largest) ? largest : 1.2 * (highest / lowest - 1.0);
  std::vector<double> spreads(count);
  for (std::size_t k = 0; k < count; ++k) {
    spreads[k] =
        end * static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(count, 2) - 1);
  }
  return spreads;
}

}  // namespace howl
