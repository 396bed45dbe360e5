// The delays at which one record's likelihood has a maximum. A cycle of one frequency tells a delay
// but for half periods, as the flame's slope may have either sign: only its harmonics and the noise
// beside it tell these apart, and a model that misses some of either may take the wrong one, with
// an interval that knows of no other. Which delays compete, and how far behind they are, must be
// seen.
//
// The scan begins with the given acoustics and noise at each delay at which the flame leaves least
// of q (point_starts.h), with the flame of that delay, and goes up to the maximum from each.
#ifndef HOWL_ESTIMATION_RECORD_FIT_DELAY_MAXIMA_H_
#define HOWL_ESTIMATION_RECORD_FIT_DELAY_MAXIMA_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

// The most likely of the maxima, that of `fit` with them, scanned again from there as long as that
// leads to a better one: acoustics that belong to a wrong delay hide the right one.
PointFit BestByDelay(const RecordSpectra& record, const PointStructure& structure,
                     const PointPrior& prior, PointFit fit);

// Starts with other delays than `parameters` have: the loops of other operating points, and
// `parameters` at the delay at which the flame leaves least of q. Each has the flame of its delay,
// as far as the prior reaches, and as much noise as that leaves.
std::vector<Eigen::VectorXd> OtherDelayStarts(const RecordSpectra& record,
                                              const PointStructure& structure,
                                              const PointPrior& prior,
                                              const Eigen::VectorXd& parameters,
                                              const std::vector<Eigen::VectorXd>& of_other_points);

struct DelayMaximum {
  double tau = 0.0;         // in radians of the cycle
  double nats_below = 0.0;  // the given parameters' posterior; below 0: more likely than they
};

// Others than that of `parameters`, the most likely first.
std::vector<DelayMaximum> OtherDelayMaxima(const RecordSpectra& record,
                                           const PointStructure& structure, const PointPrior& prior,
                                           const Eigen::VectorXd& parameters);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_DELAY_MAXIMA_H_
