// The trade-off of estimation/family/answers/tradeoff.h for two modes whose M (or M / N) is shared,
// without a random draw. With the shared value and the window [v, (1 + spread) v] of omega given,
// going up the chain of phi and taking the least xi that fits is optimal: a smaller xi never hurts
// those that follow. Least xi: the root in xi of omega(xi) = top of the window, at the phase and
// gain that put omega lowest. The window stands best as high as it can; the shared value is
// searched on a grid that is then refined. The member found is tested, so that what is returned is
// reached: an upper bound.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_TWO_MODE_TRADEOFF_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_TWO_MODE_TRADEOFF_H_

#include <optional>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

// Two modes, M or M / N shared with a finite upper bound, nothing else shared, N and tau free,
// xi ordered by phi, and no least gain at a line: that may ask for more than the least xi.
bool HasGreedyTradeoff(const FamilyProblem& problem);

// The smallest largest-xi found under the problem's own omega_spread_max; no value where no member
// was found.
std::optional<double> GreedySmallestXi(const FamilyProblem& problem);

// Members at the extremes of the parameters, over a grid of shared values and windows: under
// the conditions of HasGreedyTradeoff.
std::vector<Member> ExtremeMembers(const FamilyProblem& problem);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_TWO_MODE_TRADEOFF_H_
