// What slow changes of a loop's parameters (slow_changes.h) make of its cuts.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_SLOW_PARTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_SLOW_PARTS_H_

#include <Eigen/Core>

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

// Q in cut A and in cut B, on the edges of the record's bins.
Eigen::VectorXcd HeatReleaseOfAcoustics(const RecordSpectra& record, const LoopPoint& point);
Eigen::VectorXcd HeatReleaseOfFlame(const RecordSpectra& record, const LoopPoint& point);

// What they take off F in the return difference, on its bins: the sum of k Z / P and r Y / P.
Eigen::VectorXcd SlowFeedback(const RecordSpectra& record, const LoopPoint& point);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_SLOW_PARTS_H_
