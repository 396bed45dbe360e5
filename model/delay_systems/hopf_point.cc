#include "model/delay_systems/hopf_point.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/delay_systems/delay_linear.h"
#include "model/numerics/chebyshev.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

using Complex64 = std::complex<double>;
using internal::CharacteristicMatrix;
using internal::Linearise;
using internal::Linearised;

// A complex matrix as the real one that acts on (Re v, Im v).
Eigen::MatrixXd AsReal(const Eigen::MatrixXcd& d) {
  const Eigen::Index n = d.rows();
  Eigen::MatrixXd real(2 * n, 2 * n);
  real << d.real(), -d.imag(), d.imag(), d.real();
  return real;
}

Eigen::VectorXd AsReal(const Eigen::VectorXcd& v) {
  Eigen::VectorXd real(2 * v.size());
  real << v.real(), v.imag();
  return real;
}

// l_j at x of the polynomials through the Chebyshev points cos(i pi / n), by their barycentric
// form.
Eigen::RowVectorXd InterpolationAt(double x, int n) {
  Eigen::RowVectorXd weights(n + 1);
  for (int i = 0; i <= n; ++i) {
    const double apart = x - std::cos(M_PI * i / n);
    if (std::abs(apart) < 1e-14) {
      weights.setZero();
      weights(i) = 1.0;
      return weights;
    }
    weights(i) = (i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == n ? 0.5 : 1.0) / apart;
  }
  return weights / weights.sum();
}

// dD/dlambda v; the rest state moves with the parameter.
Eigen::VectorXcd ByParameter(const DelaySystem& system, double parameter,
                             const Eigen::VectorXd& rest, double omega, const Eigen::VectorXcd& v) {
  const double step = 1e-4 * std::max(1.0, std::abs(parameter));
  const auto at = [&](double p) -> Eigen::VectorXcd {
    const Eigen::VectorXd moved = FindRest(system, p, rest).value_or(rest);
    return CharacteristicMatrix(Linearise(system, p, moved), system.delays, {0.0, omega}) * v;
  };
  return (at(parameter + step) - at(parameter - step)) / (2.0 * step);
}

// dD/ds v at s = j omega.
Eigen::VectorXcd ByRoot(const Linearised& a, const std::vector<double>& delays, double omega,
                        const Eigen::VectorXcd& v) {
  Eigen::VectorXcd out = v;
  for (std::size_t k = 0; k < delays.size(); ++k) {
    out += delays[k] * std::polar(1.0, -omega * delays[k]) * (a.delayed[k].cast<Complex64>() * v);
  }
  return out;
}

std::optional<HopfPoint> Refine(const DelaySystem& system, Eigen::VectorXd rest, double parameter,
                                double omega) {
  const Eigen::Index n = system.dimension;
  Linearised a = Linearise(system, parameter, rest);
  const SingularValues singular =
      DecomposeSingular(AsReal(CharacteristicMatrix(a, system.delays, {0.0, omega})));
  const Eigen::VectorXd null = singular.v.col(2 * n - 1);
  Eigen::VectorXcd v =
      null.head(n).cast<Complex64>() + Complex64(0.0, 1.0) * null.tail(n).cast<Complex64>();
  const Eigen::VectorXcd v0 = v;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Eigen::MatrixXcd d = CharacteristicMatrix(a, system.delays, {0.0, omega});
    const Eigen::VectorXcd by_root = ByRoot(a, system.delays, omega, v);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
    jacobian.topLeftCorner(2 * n, 2 * n) = AsReal(d);
    jacobian.col(2 * n).head(2 * n) = AsReal(Eigen::VectorXcd(Complex64(0.0, 1.0) * by_root));
    jacobian.col(2 * n + 1).head(2 * n) = AsReal(ByParameter(system, parameter, rest, omega, v));
    jacobian.row(2 * n).head(2 * n) << v0.real().transpose(), v0.imag().transpose();
    jacobian.row(2 * n + 1).head(2 * n) << -v0.imag().transpose(), v0.real().transpose();
    Eigen::VectorXd residual(2 * n + 2);
    const Complex64 scale = v0.dot(v) - 1.0;
    residual << AsReal(Eigen::VectorXcd(d * v)), scale.real(), scale.imag();
    const Eigen::VectorXd step = SolveByLu(jacobian, residual);
    if (!step.allFinite()) return std::nullopt;
    v -=
        step.head(n).cast<Complex64>() + Complex64(0.0, 1.0) * step.segment(n, n).cast<Complex64>();
    omega -= step(2 * n);
    parameter -= step(2 * n + 1);
    const auto moved = FindRest(system, parameter, rest);
    if (!moved) return std::nullopt;
    rest = *moved;
    a = Linearise(system, parameter, rest);
    if (step.tail(2).norm() > 1e-12 * (1.0 + omega)) continue;
    // w^* (dD/ds ds + dD/dlambda dlambda) v = 0 with w the left null vector.
    const SingularValues left =
        DecomposeSingular(AsReal(CharacteristicMatrix(a, system.delays, {0.0, omega})).transpose());
    const Eigen::VectorXd w_real = left.v.col(2 * n - 1);
    const Eigen::VectorXcd w =
        w_real.head(n).cast<Complex64>() + Complex64(0.0, 1.0) * w_real.tail(n).cast<Complex64>();
    const Complex64 rate = -w.dot(ByParameter(system, parameter, rest, omega, v)) /
                           w.dot(ByRoot(a, system.delays, omega, v));
    return HopfPoint{parameter, omega, rate.real()};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Eigen::VectorXd> FindRest(const DelaySystem& system, double parameter,
                                        const Eigen::VectorXd& start) {
  Eigen::VectorXd x = start, f(system.dimension);
  for (int iteration = 0; iteration < 50; ++iteration) {
    system.rate(parameter, x, std::vector<Eigen::VectorXd>(system.delays.size(), x), &f);
    if (f.norm() == 0.0) return x;
    const Linearised a = Linearise(system, parameter, x);
    Eigen::MatrixXd jacobian = a.present;
    for (const Eigen::MatrixXd& one : a.delayed) jacobian += one;
    const Eigen::VectorXd step = SolveByLu(jacobian, f);
    if (!step.allFinite()) return std::nullopt;
    x -= step;
    if (step.norm() <= 1e-14 * (1.0 + x.norm())) return x;
  }
  return std::nullopt;
}

std::vector<Complex64> CharacteristicRoots(const DelaySystem& system, double parameter,
                                           const Eigen::VectorXd& rest, int points) {
  const Linearised a = Linearise(system, parameter, rest);
  const Eigen::Index n = system.dimension;
  const double longest = system.LongestDelay();
  // Point 0 is the present, point `points` the longest delay ago.
  const Eigen::MatrixXd d = (2.0 / longest) * ChebyshevDifferentiation(points);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n * (points + 1), n * (points + 1));
  g.topLeftCorner(n, n) = a.present;
  for (std::size_t k = 0; k < system.delays.size(); ++k) {
    const Eigen::RowVectorXd weights =
        InterpolationAt(1.0 - 2.0 * system.delays[k] / longest, points);
    for (int j = 0; j <= points; ++j) g.block(0, n * j, n, n) += weights(j) * a.delayed[k];
  }
  for (int i = 1; i <= points; ++i) {
    for (int j = 0; j <= points; ++j) {
      g.block(n * i, n * j, n, n).diagonal().setConstant(d(i, j));
    }
  }
  const Eigen::VectorXcd eigenvalues = Eigenvalues(g);
  std::vector<Complex64> roots(eigenvalues.begin(), eigenvalues.end());
  std::ranges::sort(roots, [](const Complex64& l, const Complex64& r) {
    return l.real() != r.real() ? l.real() > r.real() : l.imag() > r.imag();
  });
  return roots;
}

std::optional<HopfPoint> FindHopf(const DelaySystem& system, double parameter_low,
                                  double parameter_high, const Eigen::VectorXd& rest_start) {
  double low = parameter_low, high = parameter_high;
  Eigen::VectorXd rest = rest_start;
  const auto rightmost = [&](double parameter) -> std::optional<Complex64> {
    const auto found = FindRest(system, parameter, rest);
    if (!found) return std::nullopt;
    rest = *found;
    const Complex64 root = CharacteristicRoots(system, parameter, rest).front();
    return Complex64(root.real(), std::abs(root.imag()));
  };
  const auto at_low = rightmost(low), at_high = rightmost(high);
  if (!at_low || !at_high || (at_low->real() > 0.0) == (at_high->real() > 0.0)) return std::nullopt;
  // A few halvings bring Newton's method near enough.
  std::optional<Complex64> at_middle;
  for (int halving = 0; halving < 6; ++halving) {
    const double middle = 0.5 * (low + high);
    at_middle = rightmost(middle);
    if (!at_middle) return std::nullopt;
    ((at_middle->real() > 0.0) == (at_low->real() > 0.0) ? low : high) = middle;
  }
  if (at_middle->imag() == 0.0) return std::nullopt;
  const auto hopf = Refine(system, rest, 0.5 * (low + high), at_middle->imag());
  const double margin = std::abs(parameter_high - parameter_low);
  if (!hopf || std::abs(hopf->parameter - 0.5 * (parameter_low + parameter_high)) > margin) {
    return std::nullopt;
  }
  return hopf;
}

}  // namespace howl
