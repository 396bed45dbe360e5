// The normal equations of a fit to a record's bins, of which neighbours are correlated.
#ifndef HOWL_DIAGNOSIS_FIT_BIN_GRAM_H_
#define HOWL_DIAGNOSIS_FIT_BIN_GRAM_H_

#include <Eigen/Core>

#include "diagnosis/numerics/real_gram.h"
#include "diagnosis/records/cut_record.h"

namespace howl {

// Re(A^H W B) of as many independent bins as the record tells.
inline Eigen::MatrixXd BinGram(const Eigen::MatrixXcd& a, const Eigen::VectorXd& weight,
                               const Eigen::MatrixXcd& b) {
  return RealGram(weight, a, b) / kBinCorrelation;
}

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_BIN_GRAM_H_
