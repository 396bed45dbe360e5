// Which parameters, and combinations of parameters, the data determine at a solution.
//
// J: Jacobian of the whitened residuals by the logarithms of the parameters, J = U S V^T. A right
// singular vector with a singular value that vanishes is a direction along which parameters can
// change together and no residual changes. A direction whose standard deviation 1 / s is more than
// a factor e is undetermined for practical purposes and is reported too.
//
// Each set of parameters that residuals connect is treated by itself, so that directions of
// experiments that share nothing are not mixed. Where parameters that experiments share connect
// more than kWidestSet of them, each experiment's own parameters are eliminated first
// (estimation/fit/substructure.h). The rank, the free directions and the covariance are the same,
// and the work grows in proportion to the number of experiments. The directions that are
// determined, but to no better than a factor e, are then taken from each experiment's own
// covariance instead of from singular vectors over all experiments.
#ifndef HOWL_ESTIMATION_FIT_IDENTIFIABILITY_H_
#define HOWL_ESTIMATION_FIT_IDENTIFIABILITY_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "estimation/fit/jacobian_block.h"
#include "estimation/fit/log_covariance.h"

namespace howl {

inline constexpr int kWidestSet = 100;  // parameters; a singular value decomposition of 0.1 s

struct UndeterminedDirection {
  Eigen::SparseVector<double> direction;  // unit length, in logarithms of the parameters
  double log_std = 0.0;  // along the direction; infinite when no residual changes along it
  std::string text;      // "omega_hz, xi and N of exp1 trade off along (...)"
};

struct Identifiability {
  int rank = 0;
  // Of the logarithms, over the determined directions: the pseudo-inverse of J^T J.
  LogCovariance covariance;
  // The standard deviation of each logarithm, which is the relative one of the parameter; infinite
  // when the parameter takes part in a direction along which no residual changes.
  std::vector<double> log_std;
  std::vector<UndeterminedDirection> undetermined;
};

// `names` are the parameters', one a column of J, and `shared` tells which of them more than one
// experiment may have. Fixed parameters have no column. `widest`: kWidestSet, but for tests.
Identifiability ComputeIdentifiability(const std::vector<JacobianBlock>& jacobian,
                                       const std::vector<std::string>& names,
                                       const std::vector<bool>& shared, int widest = kWidestSet);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_IDENTIFIABILITY_H_
