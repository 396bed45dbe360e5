// Which mistake in the data would make a bad fit a good one.
//
// Each possible mistake (mistakes.h) is undone, in all experiments and in each of the worst alone,
// and the fit is made again. A mistake is named when the fit without it is a fit (it converges and
// stands on no guard rail), costs at least kMuchBetter nats less, and leaves no more than kMostLeft
// of the cost: a model that is merely wrong keeps most of its cost whatever is undone. Where
// several do nearly as well as the best (within kAlike nats), all are named: the data cannot tell
// them apart. A fit that costs less than kMuchBetter is never suspected.
//
// Transfers take no part, because analysis_health.h checks their sign and order over their whole
// band. A record that has a transfer is not suspected of a wrong sign or order here, where a rig
// whose delay varies over its operating points can look like p and q taken for each other. Costs
// are compared over the same residuals.
#ifndef HOWL_ESTIMATION_HEALTH_MISTAKE_SEARCH_H_
#define HOWL_ESTIMATION_HEALTH_MISTAKE_SEARCH_H_

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "estimation/fit/joint_fit.h"
#include "estimation/health/finding.h"

namespace howl {

// 10 nats: odds of 20 000 to 1, which some fifty mistakes tried leave above 100 to 1.
inline constexpr double kMuchBetter = 10.0;
inline constexpr double kMostLeft = 0.25;
inline constexpr double kAlike = 2.0;

struct MistakeSearch {
  std::span<const std::string> recorded;  // experiments whose numbers come from records
  SolverSpec solver;
  std::uint64_t seed = 1;
  int threads = 0;
};

// fit: the solution of `problem`, which was made with `residuals`.
Health FindMistakes(const JointProblem& problem, const ResidualSet& residuals, const JointFit& fit,
                    const MistakeSearch& search);

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_MISTAKE_SEARCH_H_
