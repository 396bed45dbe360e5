// Block elimination for many parameters that a few shared ones connect, which tells what the data
// determine of them: with A_i and B_i the columns of J of block i and of the shared parameters, and
// A_i = U_i S_i V_i^T over the singular values that do not vanish,
//
//   B = stack (I - U_i U_i^T) B_i = U S W^T,   K = W S^-2 W^T,
//   D_i = V_i S_i^-2 V_i^T,                    Y = (-V_i S_i^-1 U_i^T B_i; I),
//   (J^T J)^- = D + Y K Y^T.
//
// Directions along which no residual changes are those of each A_i by itself, and Y w for the w
// that B leaves free; N is their orthonormal basis. The pseudo-inverse is the above multiplied by
// (I - N N^T) on both sides, and has the same form. J and its factors are never squared, so that
// the rank is decided as a singular value decomposition of J decides it. (Golub, Van Loan, Matrix
// Computations, 4th ed., sections 5.5 and 6.1; Ben-Israel, Greville, Generalized Inverses, chapter
// 1.)
#ifndef HOWL_ESTIMATION_FIT_SUBSTRUCTURE_H_
#define HOWL_ESTIMATION_FIT_SUBSTRUCTURE_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/fit/connected_columns.h"
#include "estimation/fit/jacobian_block.h"
#include "estimation/fit/log_covariance.h"

namespace howl {

struct FreeSpace {
  std::vector<int> columns;
  Eigen::MatrixXd rows;  // a basis, one vector a row
};

struct Substructure {
  int rank = 0;
  LogCovariance::Set covariance;  // its last block is what is shared
  std::vector<FreeSpace> free;    // of the blocks, then of all
};

// The elimination in one connected set; singular values up to `least` count as zero.
Substructure AnalyseSubstructure(const std::vector<JacobianBlock>& jacobian,
                                 const ConnectedSet& set, const std::vector<bool>& shared,
                                 double least);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_SUBSTRUCTURE_H_
