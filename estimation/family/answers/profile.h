// The profile of a scalar (a parameter, or a prediction): the least cost that a model has with the
// scalar held at each of a row of values, followed in both directions from the best fit, each to
// the edge of the family (a cost that is no longer acceptable) or to the scalar's bounds. The steps
// adapt to the cost, not to the scalar, so a flat direction is walked in long strides and nothing
// is cropped at symmetric bounds.
//
// Self-check: every point is minimised a second time, from its outer neighbour, on the way back. A
// point whose two minima differ has not converged; it is flagged, and the lower one is kept. A cost
// below that of the start is flagged too, because the start then was not the best fit.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PROFILE_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PROFILE_H_

#include <functional>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

struct ConstrainedFit {
  double cost = 0.0;
  std::vector<double> parameters;  // the caller's own, as the next search starts from them
  bool converged = false;
};

// The least cost with the scalar held at `value`, searched from `start`.
using ConstrainedMinimum =
    std::function<ConstrainedFit(double value, const std::vector<double>& start)>;

struct ProfileOptions {
  Range bounds{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double cost_max = 0.0;         // the edge: cost at which a model is no longer acceptable
  double first_step = 0.0;       // of the scalar; 0: a hundredth of its value
  std::size_t max_points = 60;   // a direction
  double edge_precision = 1e-4;  // of the edge, relative to its distance from the best fit
  double agreement = 1e-3;       // of the two minima, relative to cost_max - best cost
};

enum class ProfileEnd { kEdge, kBound, kFailed, kPoints };

struct ProfilePoint {
  double value = 0.0;
  double cost = 0.0;
  bool flagged = false;  // did not converge, or the two minima differ
  std::vector<double> parameters;
};

struct Profile {
  std::vector<ProfilePoint> points;  // by increasing value
  double lo = 0.0;                   // where the cost reaches cost_max, or the bound
  double hi = 0.0;
  ProfileEnd lo_end = ProfileEnd::kFailed;
  ProfileEnd hi_end = ProfileEnd::kFailed;
  bool start_was_best = true;
  std::size_t flagged = 0;
  bool IsSound() const { return flagged == 0 && start_was_best; }
};

Profile ComputeProfile(const ConstrainedMinimum& minimise, double best_value,
                       const ConstrainedFit& best, const ProfileOptions& options);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PROFILE_H_
