// Polynomial interpolation on P equally spaced nodes (Lagrange), P even, centred:
//
//   f(x) ~ sum_j l_j(x) f(x_j),   x_j = j + kFirstNode<P>,   0 <= x < 1 between the middle nodes
//
// Error O(h^P) for spacing h. With P = 6 the nodes are -2 .. 3. Centred weights have a gain of at
// most one at every frequency, so that they never make a stable loop unstable.
#ifndef HOWL_MODEL_NUMERICS_LAGRANGE_H_
#define HOWL_MODEL_NUMERICS_LAGRANGE_H_

#include <array>
#include <cstddef>

namespace howl {

template <int P>
inline constexpr int kFirstNode = -(P / 2 - 1);

// l_j(x) = prod_{i != j} (x - x_i) / (x_j - x_i). Exactly 0 or 1 when x is a node.
template <int P>
constexpr std::array<double, P> LagrangeWeights(double x) {
  static_assert(P % 2 == 0);
  std::array<double, P> weights{};
  for (int j = 0; j < P; ++j) {
    double numerator = 1.0;
    double denominator = 1.0;
    for (int i = 0; i < P; ++i) {
      if (i == j) continue;
      numerator *= x - (i + kFirstNode<P>);
      denominator *= j - i;
    }
    weights[static_cast<std::size_t>(j)] = numerator / denominator;
  }
  return weights;
}

// Coefficients c[j][k] of l_j(x) = sum_k c[j][k] x^k.
template <int P>
constexpr std::array<std::array<double, P>, P> LagrangeCoefficients() {
  std::array<std::array<double, P>, P> coefficients{};
  for (int j = 0; j < P; ++j) {
    std::array<double, P> polynomial{};
    polynomial[0] = 1.0;
    double denominator = 1.0;
    int degree = 0;
    for (int i = 0; i < P; ++i) {
      if (i == j) continue;
      const double root = i + kFirstNode<P>;
      ++degree;
      for (int k = degree; k >= 0; --k) {
        const auto at = static_cast<std::size_t>(k);
        polynomial[at] = (k > 0 ? polynomial[at - 1] : 0.0) - root * polynomial[at];
      }
      denominator *= j - i;
    }
    for (int k = 0; k < P; ++k) {
      coefficients[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] =
          polynomial[static_cast<std::size_t>(k)] / denominator;
    }
  }
  return coefficients;
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_LAGRANGE_H_
