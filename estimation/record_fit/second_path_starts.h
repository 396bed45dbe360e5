// Where fits of a flame that answers twice begin, beside a loop whose flame answers once.
//
// One path found at its maximum, a second one is a step of the likelihood of the closed loop: cut B
// alone would take what q tells of p at once, through the acoustics, for a path of the flame.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SECOND_PATH_STARTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_SECOND_PATH_STARTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "estimation/record_fit/loop/point_prior.h"

namespace howl {

// How many are gone on from.
inline constexpr std::size_t kSecondPathStarts = 3;

// Of a structure with a second path, at most as many as asked: the Newton steps of all parameters
// from no second path at all, one for each lambda whose first step gains more than those beside it.
std::vector<Eigen::VectorXd> WithTwoPaths(const RecordSpectra& record,
                                          const PointStructure& structure, const PointPrior& prior,
                                          Eigen::VectorXd parameters, std::size_t count);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SECOND_PATH_STARTS_H_
