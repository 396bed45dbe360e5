#include "rig/dense.h"

#include <cmath>
#include <stdexcept>

namespace rig {

std::vector<double> SolveSymmetric(Square matrix, std::vector<double> right) {
  const std::size_t n = matrix.size();
  for (std::size_t i = 0; i < n; ++i) {
    double* row = matrix.row(i);
    for (std::size_t j = 0; j <= i; ++j) {
      const double* other = matrix.row(j);
      double sum = row[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row[k] * other[k];
      if (i != j) {
        row[j] = sum / other[j];
      } else {
        if (!(sum > 0.0)) throw std::runtime_error("a system of equations is singular");
        row[j] = std::sqrt(sum);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) right[i] -= matrix(i, k) * right[k];
    right[i] /= matrix(i, i);
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) right[i] -= matrix(k, i) * right[k];
    right[i] /= matrix(i, i);
  }
  return right;
}

}  // namespace rig
