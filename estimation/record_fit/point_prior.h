// Priors of an operating point's parameters (loop_point.h): normal, in the units of the record, so
// that they are the same for every rig, rate and length. They are wide enough that a record of a
// hundred cycles decides (tests/estimation/record_fit), and keep finite what it cannot tell.
#ifndef HOWL_ESTIMATION_RECORD_FIT_POINT_PRIOR_H_
#define HOWL_ESTIMATION_RECORD_FIT_POINT_PRIOR_H_

#include <Eigen/Core>

#include "estimation/record_fit/loop_point.h"

namespace howl {

struct PointPrior {
  Eigen::VectorXd mean;
  Eigen::VectorXd deviation;

  double LogDensity(const Eigen::VectorXd& parameters) const;
};

PointPrior PriorOf(const PointStructure& structure, const RecordSpectra& record);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_POINT_PRIOR_H_
