// Products of tall matrices, c += a^T b, in vectors as wide as the machine has: sums over rows of
// the products of each column of a with each of b.
//
// Eigen takes the vectors that all machines of the kind have, which are a quarter as wide. The bits
// do not depend on the width (vector_clones.h).
#ifndef HOWL_MODEL_NUMERICS_TRANSPOSED_PRODUCT_H_
#define HOWL_MODEL_NUMERICS_TRANSPOSED_PRODUCT_H_

#include <Eigen/Core>

namespace howl {

// Any rows, as many of a as of b; c has as many rows as a has columns, and as many columns as b.
void AddTransposedProduct(const Eigen::Ref<const Eigen::MatrixXd>& a,
                          const Eigen::Ref<const Eigen::MatrixXd>& b,
                          Eigen::Ref<Eigen::MatrixXd> c);

// On and above the diagonal alone; c is square.
void AddUpperOfTransposedProduct(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                 const Eigen::Ref<const Eigen::MatrixXd>& b,
                                 Eigen::Ref<Eigen::MatrixXd> c);

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_TRANSPOSED_PRODUCT_H_
