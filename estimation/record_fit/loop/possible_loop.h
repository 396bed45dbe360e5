// Which loops are possible, and how near to the edge of them one is.
//
// With K and U (loop_tail.h) at the end of the octave above a record's band, with tau_0 the least
// delay that the band tells from none, and with rho the spread of gamma's delays, a loop is
// possible where
//
//   x < 1 for each x of |K|, |U|, tau_0 / tau, rho
//
// Beyond the first two edges it grows at all frequencies, beyond the third p and q are mixed within
// a sample, beyond the fourth most of the flame answers at once (flame_path.h). No rig stands at an
// edge: the density of what a loop may be is the product of 1 - x^2, which vanishes there. Without
// it a fit may come to rest against an edge, where steps are cut short without end and there is no
// curvature of which an evidence could be made.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_POSSIBLE_LOOP_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_POSSIBLE_LOOP_H_

#include <Eigen/Core>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/loop_tail.h"

namespace howl {

bool IsPossible(const RecordSpectra& record, const LoopPoint& point, const LoopTail& tail);
bool IsPossible(const RecordSpectra& record, const LoopPoint& point);

// Its logarithm, for a loop that is possible.
double LogDensityOfPossible(const RecordSpectra& record, const LoopPoint& point);

// By the parameters of acoustics, path and flame; and what the edges add to their information.
Eigen::VectorXd GradientOfPossible(const RecordSpectra& record, const PointStructure& structure,
                                   const LoopPoint& point);
Eigen::MatrixXd InformationOfPossible(const RecordSpectra& record, const PointStructure& structure,
                                      const LoopPoint& point);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_POSSIBLE_LOOP_H_
