// A fit of one operating point under a prior that other points tell: begun where the point stands
// and, if asked, at what the prior expects too, of all or of the flame's path alone, with the flame
// that then leaves least of q. The most likely of these.
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

PointFit FitUnder(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, const Eigen::VectorXd& at, bool from_prior);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_FIT_UNDER_PRIOR_H_
