// The log posterior of one point's record (whittle.h, return_difference.h, point_prior.h), of which
// all that a parameter does not move is kept from one evaluation to the next.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_LIKELIHOOD_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_LIKELIHOOD_H_

#include <Eigen/Core>

#include "estimation/record_fit/loop/beside_band.h"
#include "estimation/record_fit/loop/kept_loop.h"
#include "estimation/record_fit/whittle/whittle_weights.h"

namespace howl {

class PointLikelihood {
 public:
  // Both must outlive it.
  PointLikelihood(const RecordSpectra& record, const PointStructure& structure);

  // ln L, -infinity where the parameters are impossible.
  double Value(const Eigen::VectorXd& parameters);
  // By the parameters from `first` on, in the time of two or three values; of others it may be
  // anything. A bin's noise is by far the cheapest to take back.
  Eigen::VectorXd Gradient(const Eigen::VectorXd& parameters, Eigen::Index first = 0);
  // The information of whittle.h.
  Eigen::MatrixXd Information(const Eigen::VectorXd& parameters);

 private:
  void MoveTo(const Eigen::VectorXd& parameters);

  const RecordSpectra& record_;
  const PointStructure& structure_;
  KeptLoop loop_;
  WhittleWeights weights_;
  LoopGradient beside_;
  bool beside_known_ = false;  // at the present parameters
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_LIKELIHOOD_H_
