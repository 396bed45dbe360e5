// How the parameters of a rig's operating points vary with the operating parameter, estimated from
// what each record tells of them.
//
//   u_e = m + b z_e + s e_e,   e_e standard normal,   z the operating parameter less its mean over
//   its deviation
//
// for each parameter by itself. m and b have normal priors; s^2 is scaled inverse chi-squared with
// one degree of freedom, so that what the points have in common may come near to being the same; s
// is at most the deviation of a point's prior when nothing is known of the others: points of one
// rig differ by no more than rigs do. What a record tells is normal about its most likely
// parameters (Laplace). The posteriors of the u_e, of (m, b) and of s^2 are taken as independent
// (mean-field variational Bayes, Attias 2000; the random effects of Laird & Ware 1982), each in
// turn given the others until they stand still.
//
// Errors of the model, of one kind and without a unit, have m = b = 0 and one s together, at most
// one: how far the model errs is a property of the rig, which all its lines and points tell.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_PARAMETER_LAW_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_PARAMETER_LAW_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "estimation/record_fit/loop/point_prior.h"

namespace howl {

// What one record tells of the parameters: ln L = information' u - u' precision u / 2.
struct ParameterEvidence {
  double z = 0.0;
  Eigen::MatrixXd precision;
  Eigen::VectorXd information;
};

struct ParameterLaw {
  Eigen::VectorXd mean;    // m
  Eigen::VectorXd trend;   // b
  Eigen::VectorXd spread;  // s, as the mean of 1 / s^2 has it
  Eigen::VectorXd widest;  // of s
  // Of (m, b), for each parameter.
  std::vector<Eigen::Matrix2d> covariance;
  std::size_t points = 0;  // from which it was estimated
  // Of each parameter: how many values told of its s.
  Eigen::VectorXd values;

  // By how much mean and trend of each parameter, a row each, differ in `next`, in its spreads.
  Eigen::MatrixX2d MoveTo(const ParameterLaw& next) const;
  // The law on the way to `next`, of each parameter so far as `share` says, from 0 to 1.
  ParameterLaw Toward(const ParameterLaw& next, const Eigen::VectorXd& share) const;
  // Of a point that was among those from which the law was estimated.
  PointPrior PriorAt(double z) const;
  // Of another point: Student's density, with one degree of freedom more than there were points.
  PointPrior PredictionAt(double z) const;
};

// Parameters of one kind that follow one another.
struct ErrorGroup {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

// `base`: the prior of a point when nothing is known of the others.
ParameterLaw FitParameterLaw(const std::vector<ParameterEvidence>& points, const PointPrior& base,
                             const std::vector<ErrorGroup>& errors = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_PARAMETER_LAW_H_
