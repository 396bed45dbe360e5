#include "estimation/family/tradeoff.h"

#include <algorithm>
#include <cmath>

#include "estimation/family/enumerate.h"
#include "estimation/family/feasible.h"
#include "estimation/family/local_search.h"
#include "estimation/family/transfer_starts.h"
#include "estimation/family/two_mode_tradeoff.h"
#include "estimation/family/window.h"
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

// The least largest xi that a local search reaches from members; the starts have to keep all other
// conditions.
std::optional<double> LeastXiLocally(FamilyProblem problem, const std::vector<Member>& starts) {
  std::optional<double> best;
  for (const Member& start : starts) {
    const double largest = LargestXi(start);
    problem.test.xi_max = 1.01 * largest;
    const LocalSearch search(problem);
    ConditionSet soft;
    soft.Insert(Condition::kXiMax);
    const std::optional<Approach> inside = search.FindMember(start);
    if (!inside || !Holds(problem, inside->member)) continue;
    const std::optional<Approach> least = search.Minimise(inside->member, soft);
    if (!least || !Holds(problem, least->member)) continue;
    const double xi = LargestXi(least->member);
    best = best ? std::min(*best, xi) : xi;
  }
  return best;
}

}  // namespace

TradeoffPoint ComputeTradeoff(const FamilyProblem& problem, double omega_spread,
                              std::uint64_t seed) {
  TradeoffPoint point{omega_spread, std::nullopt, HasExactWindows(problem)};
  FamilyProblem at = problem;
  at.test.omega_spread_max = omega_spread;
  at.test.xi_max = std::numeric_limits<double>::infinity();
  if (point.exact) {
    point.xi_max = SmallestLargestXi(MakeWindowProblem(at, 0.0));
  } else if (NeedsTransferStarts(at)) {
    point.xi_max = LeastXiLocally(at, TransferStarts(at, 1, seed));
  } else {
    if (HasGreedyTradeoff(at)) point.xi_max = GreedySmallestXi(at);
    if (!point.xi_max) point.xi_max = SearchSmallestXi(at, seed);
  }
  return point;
}

std::vector<TradeoffPoint> ComputeTradeoff(const FamilyProblem& problem,
                                           std::span<const double> omega_spreads, int threads,
                                           std::uint64_t seed) {
  std::vector<TradeoffPoint> points(omega_spreads.size());
  RunUnits(points.size(), threads, [&](std::size_t k) {
    points[k] = ComputeTradeoff(problem, omega_spreads[k], seed + 1000 * k);
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
