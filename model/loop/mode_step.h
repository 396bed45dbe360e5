// One acoustic mode in time, propagated exactly over a step of h seconds.
//
// The mode N s / (s^2 + 2 omega xi s + omega^2) (the paper, (5a)) is, with
// y = omega * integral of p,
//
//   y' = omega p,    p' = -omega y - 2 omega xi p + N q
//
// and over one step, with q interpolated by the polynomial through P equally spaced samples,
//
//   [y; p](h) = E [y; p](0) + sum_j w_j q_j,   E = exp(A h),   w_j = h sum_k c_jk mu_k(A h) [0; N]
//   mu_k(Z) = integral from 0 to 1 of exp(Z (1 - s)) s^k ds = sum_m Z^m k! / (m + k + 1)!
//
// The propagation of y and p is exact for any damping; only q is approximated, to order P. The
// state can be in any unit of p; omega in rad/s.
#ifndef HOWL_MODEL_LOOP_MODE_STEP_H_
#define HOWL_MODEL_LOOP_MODE_STEP_H_

#include <array>
#include <cmath>

#include "model/numerics/lagrange.h"

namespace howl {

struct Matrix2 {
  double a, b, c, d;  // [a b; c d]
};

template <int P>
struct ModeStep {
  Matrix2 exponential{};
  std::array<double, P> weight_y{};  // of q_j, j-th node from the oldest
  std::array<double, P> weight_p{};
};

namespace internal {

inline Matrix2 Multiply(const Matrix2& l, const Matrix2& r) {
  return {l.a * r.a + l.b * r.c, l.a * r.b + l.b * r.d, l.c * r.a + l.d * r.c,
          l.c * r.b + l.d * r.d};
}

}  // namespace internal

template <int P>
ModeStep<P> MakeModeStep(double omega_rad_s, double xi, double coefficient, double step_s) {
  constexpr auto kCoefficients = LagrangeCoefficients<P>();
  const double w = omega_rad_s * step_s;
  const Matrix2 z{0.0, w, -w, -2.0 * xi * w};

  // The highest moment by its series, the others by mu_(k-1) = (Z mu_k + 1) / k: downwards, which
  // is stable where Z is small.
  std::array<Matrix2, P> moments{};
  double factor = 1.0 / P;
  Matrix2 power{1.0, 0.0, 0.0, 1.0};
  Matrix2 sum{factor, 0.0, 0.0, factor};
  for (int m = 1; m < 200; ++m) {
    power = internal::Multiply(power, z);
    factor /= m + P;
    const Matrix2 before = sum;
    sum = {sum.a + factor * power.a, sum.b + factor * power.b, sum.c + factor * power.c,
           sum.d + factor * power.d};
    if (m > 2 && sum.a == before.a && sum.b == before.b && sum.c == before.c && sum.d == before.d) {
      break;
    }
  }
  moments[P - 1] = sum;
  for (std::size_t k = P - 1; k > 0; --k) {
    const Matrix2 product = internal::Multiply(z, moments[k]);
    const double scale = 1.0 / static_cast<double>(k);
    moments[k - 1] = {(product.a + 1.0) * scale, product.b * scale, product.c * scale,
                      (product.d + 1.0) * scale};
  }

  ModeStep<P> step;
  const Matrix2 last = internal::Multiply(z, moments[0]);
  step.exponential = {1.0 + last.a, last.b, last.c, 1.0 + last.d};
  const double gain = coefficient * step_s;
  for (std::size_t j = 0; j < P; ++j) {
    double y = 0.0;
    double p = 0.0;
    for (std::size_t k = 0; k < P; ++k) {
      y += kCoefficients[j][k] * moments[k].b;
      p += kCoefficients[j][k] * moments[k].d;
    }
    step.weight_y[j] = gain * y;
    step.weight_p[j] = gain * p;
  }
  return step;
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_MODE_STEP_H_
