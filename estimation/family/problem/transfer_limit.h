// transfer_distance_max as a limit on the ellipsoid's quadratic form, which loops over many models
// compare with instead of turning each distance into a deviation
// (estimation/analysis/transfer/joint_deviation.h).
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_TRANSFER_LIMIT_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_TRANSFER_LIMIT_H_

#include <algorithm>
#include <limits>

#include "estimation/analysis/transfer/joint_deviation.h"
#include "estimation/family/problem/membership.h"

namespace howl {

// The largest MahalanobisDistance of a member.
inline double TransferLimit(const TransferEllipsoid& ellipsoid, bool second_mode,
                            double deviation_max) {
  return DistanceOfDeviation(deviation_max, std::max(1, ellipsoid.Count(second_mode)));
}

// The same for an experiment; infinite where the test does not look at its transfer.
inline double TransferLimit(const Experiment& experiment, const MembershipTest& test,
                            bool second_mode) {
  return experiment.transfer_ellipsoid ? TransferLimit(*experiment.transfer_ellipsoid, second_mode,
                                                       test.transfer_distance_max)
                                       : std::numeric_limits<double>::infinity();
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_TRANSFER_LIMIT_H_
