// A condition in the mean value form over a box of K variables,
//
//   value at the box's middle + sum slope_k (x_k - middle_k)  in  allowed,
//
// where slope_k holds the derivative everywhere in the box. Its error falls with the square of the
// box, where that of the plain expression falls with the box alone. All need a RoundingGuard.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_ROW_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_ROW_H_

#include <array>
#include <cstddef>

#include "estimation/family/bounds/contract/interval.h"

namespace howl {

inline double MiddleOf(const Interval& x) { return 0.5 * (x.lower() + x.upper()); }

template <std::size_t K>
struct CentredRow {
  Interval value;  // at the middle
  std::array<Interval, K> slope;
};

// row + weight other; both hold at the same time where both `allowed` are added likewise.
template <std::size_t K>
CentredRow<K> Combined(const CentredRow<K>& row, const Interval& weight,
                       const CentredRow<K>& other) {
  CentredRow<K> sum;
  sum.value = row.value + weight * other.value;
  for (std::size_t k = 0; k < K; ++k) sum.slope[k] = row.slope[k] + weight * other.slope[k];
  return sum;
}

// Narrows every offset x_k - middle_k by the row, and `allowed` to what the row then reaches; false
// where nothing is left. The row's bounds must be finite.
template <std::size_t K>
bool NarrowByRow(const CentredRow<K>& row, Interval& allowed, std::array<Interval, K>& offset) {
  // Sums before and after each variable, so that none is subtracted again.
  std::array<Interval, K> part;
  std::array<Interval, K + 1> after;
  after[K] = Interval(0.0);
  for (std::size_t k = K; k-- > 0;) {
    part[k] = row.slope[k] * offset[k];
    after[k] = after[k + 1] + part[k];
  }
  Interval before = row.value;
  if (!Narrow(allowed, before + after[0])) return false;
  for (std::size_t k = 0; k < K; ++k) {
    const Interval rest = allowed - (before + after[k + 1]);
    if (!Narrow(offset[k], Quotient(rest, row.slope[k]))) return false;
    before += row.slope[k] * offset[k];
  }
  return Narrow(allowed, before);
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_ROW_H_
