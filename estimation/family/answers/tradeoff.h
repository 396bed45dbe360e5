// The trade-off between a nearly constant omega and a small xi (the paper's two qualitative
// conditions pull against each other): the smallest largest-xi that any member has when omega may
// spread by no more than a given omega_spread over the experiments.
//
// One mode: exact, from estimation/family/members/drawer/window.h (a bisection at most, to machine
// precision). Two modes: the least that local searches (estimation/family/local/local_search.h)
// from several members reach, and where these do not agree and M or M / N is shared also that of
// estimation/family/members/two_mode_tradeoff.h, another algorithm altogether; on the published
// experiments the two agree to 1e-6. Shared omega, xi, N or tau: by random search. All but the
// first are reached by a member, not proved least, and marked inexact.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_TRADEOFF_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_TRADEOFF_H_

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

struct TradeoffPoint {
  double omega_spread = 0.0;
  std::optional<double> xi_max;  // nothing: no member at this spread, however large xi
  bool exact = true;
};

// xi_max of the problem's test is ignored, because the curve tells what it would have to be. The
// other conditions hold as they are.
TradeoffPoint ComputeTradeoff(const FamilyProblem& problem, double omega_spread,
                              std::uint64_t seed = 0);

std::vector<TradeoffPoint> ComputeTradeoff(const FamilyProblem& problem,
                                           std::span<const double> omega_spreads, int threads = 1,
                                           std::uint64_t seed = 0);

// Spreads from zero to where the curve is flat, for tradeoff.csv.
std::vector<double> DefaultSpreads(const FamilyProblem& problem, std::size_t count = 41);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_TRADEOFF_H_
