// What the data determine at a solution, and what they do not.
//
// J: Jacobian of the whitened residuals by the logarithms of the parameters, J = U S V^T. A right
// singular vector with a singular value that vanishes is a direction along which parameters can be
// traded without any residual noticing. One whose standard deviation 1 / s is more than a factor e
// is undetermined for practical purposes; it is reported too.
#ifndef HOWL_ESTIMATION_FIT_IDENTIFIABILITY_H_
#define HOWL_ESTIMATION_FIT_IDENTIFIABILITY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

namespace howl {

struct UndeterminedDirection {
  Eigen::VectorXd direction;  // unit length, in logarithms of the parameters
  double log_std = 0.0;       // along the direction; infinite when no residual notices it at all
  std::string text;           // "omega_hz, xi and N of exp1 trade off along (...)"
};

struct Identifiability {
  Eigen::VectorXd singular_values;  // descending
  int rank = 0;
  // Of the logarithms, over the determined directions: the pseudo-inverse of J^T J.
  Eigen::MatrixXd covariance;
  // Of each logarithm: the relative standard deviation of the parameter; infinite when it takes
  // part in a direction that no residual notices.
  std::vector<double> log_std;
  std::vector<UndeterminedDirection> undetermined;
};

// `names` are the parameters', one a column of J. Fixed parameters have no column. Works block by
// block, so that directions of experiments that share nothing are not mixed.
Identifiability ComputeIdentifiability(const Eigen::MatrixXd& jacobian,
                                       const std::vector<std::string>& names);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_IDENTIFIABILITY_H_
