// Differentiation at Chebyshev points x_i = cos(i pi / n), i = 0 .. n, on [-1, 1] (Trefethen,
// Spectral Methods in MATLAB, chapter 6): (D f)_i = f'(x_i), exact for polynomials of degree n.
#ifndef HOWL_MODEL_NUMERICS_CHEBYSHEV_H_
#define HOWL_MODEL_NUMERICS_CHEBYSHEV_H_

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace howl {

inline Eigen::MatrixXd ChebyshevDifferentiation(int n) {
  Eigen::VectorXd x(n + 1);
  for (int i = 0; i <= n; ++i) x(i) = std::cos(std::numbers::pi * i / n);
  Eigen::MatrixXd d(n + 1, n + 1);
  for (int i = 0; i <= n; ++i) {
    double row_sum = 0.0;
    for (int j = 0; j <= n; ++j) {
      if (i == j) continue;
      const double ci = i == 0 || i == n ? 2.0 : 1.0;
      const double cj = j == 0 || j == n ? 2.0 : 1.0;
      d(i, j) = ((i + j) % 2 == 0 ? 1.0 : -1.0) * ci / (cj * (x(i) - x(j)));
      row_sum += d(i, j);
    }
    d(i, i) = -row_sum;  // exact on constants, which loses least to rounding
  }
  return d;
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_CHEBYSHEV_H_
