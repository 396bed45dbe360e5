// Fits of one operating point under a prior that other points tell.
#ifndef HOWL_ESTIMATION_RECORD_FIT_FIT_UNDER_PRIOR_H_
#define HOWL_ESTIMATION_RECORD_FIT_FIT_UNDER_PRIOR_H_

#include "estimation/record_fit/point_fit.h"

namespace howl {

// These parameters, but for the flame's coefficients.
Eigen::VectorXd WithBestFlame(const RecordSpectra& record, const PointStructure& structure,
                              const Eigen::VectorXd& parameters);

// What a fit becomes where its prior moves a little, from `before`.
PointFit FitAgain(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& before, const PointPrior& prior, const PointFit& fit);

// Begun `at` these parameters and, if asked or if nothing comes of that, where the prior expects
// the point too: all of it, its acoustics alone, or the flame's path alone, with the flame that
// then leaves least of q. The most likely of these.
PointFit FitUnder(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, const Eigen::VectorXd& at, bool from_prior);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_FIT_UNDER_PRIOR_H_
