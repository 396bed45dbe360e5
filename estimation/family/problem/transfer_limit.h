// transfer_distance_max as a limit on the ellipsoid's quadratic form, which loops over many models
// compare with instead of turning each distance into a deviation
// (estimation/analysis/joint_deviation.h).
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_TRANSFER_LIMIT_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_TRANSFER_LIMIT_H_

#include <algorithm>
#include <limits>

#include "estimation/analysis/joint_deviation.h"
#include "estimation/family/problem/membership.h"

namespace howl {

// The largest MahalanobisDistance of a member; infinite where the test does not look at it.
inline double TransferLimit(const Experiment& experiment, const MembershipTest& test,
                            bool second_mode) {
  if (!experiment.transfer_ellipsoid) return std::numeric_limits<double>::infinity();
  return DistanceOfDeviation(test.transfer_distance_max,
                             std::max(1, experiment.transfer_ellipsoid->Count(second_mode)));
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_TRANSFER_LIMIT_H_
