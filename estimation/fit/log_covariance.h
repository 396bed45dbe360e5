// The covariance of the logarithms of a joint fit's parameters, stored without its n x n entries:
//
//   C = D + F M F^T
//
// for each set of parameters that residuals connect, where D is block diagonal (one block of few
// columns for each experiment) and F has a few columns for each parameter that the experiments
// share. Parameters of different sets have no covariance. A set of few parameters is one block, and
// has no F. J^T J has this form by block elimination of what belongs to one experiment.
#ifndef HOWL_ESTIMATION_FIT_LOG_COVARIANCE_H_
#define HOWL_ESTIMATION_FIT_LOG_COVARIANCE_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "estimation/fit/jacobian_block.h"

namespace howl {

class LogCovariance {
 public:
  // One set. Every one of its columns is in one of the blocks, whose parts of D are `diagonal`; row
  // k of `factor` belongs to the k-th column, the blocks' columns taken one after the other.
  struct Set {
    std::vector<std::vector<int>> blocks;
    std::vector<Eigen::MatrixXd> diagonal;
    Eigen::MatrixXd factor;  // rows x m; m may be zero
    Eigen::MatrixXd middle;  // m x m, symmetric
  };

  explicit LogCovariance(int size = 0);
  // Adds a set, whose columns must be in no other set.
  void Add(Set set);

  int size() const { return static_cast<int>(places_.size()); }
  double operator()(int row, int column) const;
  // The covariance's rows and columns with the indices in `columns`.
  Eigen::MatrixXd Of(std::span<const int> columns) const;
  // C (sum J^T J) C over the rows of `blocks`: the covariance of parameters whose data scatter
  // otherwise than stated. Each block touches columns of its own set only.
  LogCovariance Scattered(const std::vector<JacobianBlock>& blocks) const;

 private:
  struct Place {
    int set = -1;
    int block = 0;
    int within = 0;  // the block
    int row = 0;     // of the set's factor
  };
  std::vector<Place> places_;
  std::vector<Set> sets_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_LOG_COVARIANCE_H_
