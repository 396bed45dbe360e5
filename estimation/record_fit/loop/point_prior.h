// Priors of an operating point's parameters (loop_point.h): normal, in the units of the record, so
// that they are the same for every rig, rate and length. They are wide enough that a record of a
// hundred cycles decides (tests/estimation/record_fit), and keep finite what it cannot tell.
//
// Where a prior's deviation was itself estimated from a few other records the density is Student's,
// whose tails allow for that deviation's error:
//
//   ln t = c - (n + 1) / 2 ln(1 + z^2 / n),   z = (u - mean) / deviation,   n degrees of freedom
//
// as far as the deviation may err. From where its slope is that of a normal density of the widest
// deviation that any rig's points have, it falls as that one does: Student's alone would let the
// logarithm of a spectrum wander by hundreds for a few nats.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_PRIOR_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_PRIOR_H_

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

// Of a delay, in radians of the cycle: half a period, within a factor of three.
inline constexpr double kMeanTau = std::numbers::pi;
inline constexpr double kLogTau = 1.1;

struct PointPrior {
  Eigen::VectorXd mean;
  Eigen::VectorXd deviation;
  Eigen::VectorXd degrees;  // of freedom; empty: all normal, as where one is infinite
  Eigen::VectorXd widest;   // at least `deviation`; empty: Student's tails have no end

  double LogDensity(const Eigen::VectorXd& parameters) const;
  // Of the log density by z, and the precision of the normal density with the same slope there.
  Eigen::VectorXd Slope(const Eigen::VectorXd& parameters) const;
  Eigen::VectorXd Precision(const Eigen::VectorXd& parameters) const;
  // Of one parameter, in its deviations.
  double LeastPrecision(Eigen::Index i) const {
    return widest.size() > 0 ? std::pow(deviation[i] / widest[i], 2) : 0.0;
  }
  // The normal density that has the same slope there.
  PointPrior NormalAt(const Eigen::VectorXd& parameters) const;
  // The nearest parameters with which a search may begin: beyond, the density is 0 to rounding.
  Eigen::VectorXd Within(const Eigen::VectorXd& parameters) const;
};

PointPrior PriorOf(const PointStructure& structure, const RecordSpectra& record);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_PRIOR_H_
