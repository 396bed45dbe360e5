#include "model/poles.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "model/chebyshev.h"
#include "model/laplace.h"

namespace howl {
namespace {

using Complex64 = std::complex<double>;

// D1 D2 (1 - k L): entire, with the poles sought as its only zeros. Scaled by omega^4.
Complex64 Characteristic(const LoopParameters<double>& loop, double slope, Complex64 s) {
  const Acoustics<double>& a = loop.acoustics;
  const double w1 = kRadPerSPerHz * a.omega_hz;
  const double w2 = a.harmonic_ratio * w1;
  const Complex64 d1 = (s * s + 2.0 * w1 * a.xi * s + w1 * w1) / (w1 * w1);
  const Complex64 d2 = (s * s + 2.0 * w2 * a.xi * s + w2 * w2) / (w1 * w1);
  const Complex64 z = s * s / (w1 * w1);
  return d1 * d2 - slope * z * (a.N * d2 + a.M * d1) * std::exp(-loop.tau_s * s);
}

// Beyond a bound, so that no zero lies on the contour.
constexpr double kBeyond = 1e-3;  // of w

// The loop with time in units of 1 / w: all that follows is free of the frequency.
LoopParameters<double> InUnitsOfW(LoopParameters<double> loop, double w) {
  loop.acoustics.omega_hz = 1.0 / kRadPerSPerHz;
  loop.acoustics.N /= w;
  loop.acoustics.M /= w;
  loop.tau_s *= w;
  return loop;
}

// sup over the right half-plane of |s^2 / D|: its largest value on the imaginary axis.
double LargestRateGain(double xi) {
  return xi < std::numbers::sqrt2 / 2.0 ? 1.0 / (2.0 * xi * std::sqrt(1.0 - xi * xi)) : 1.0;
}

double GrowthBound(const LoopParameters<double>& loop, double slope) {
  const Acoustics<double>& a = loop.acoustics;
  const double gain =
      std::abs(slope) * (std::abs(a.N) + std::abs(a.M)) * LargestRateGain(a.xi) * 1.01;
  return std::max(std::log(gain) / loop.tau_s, 0.0) + kBeyond;
}

Eigen::MatrixXd Generator(const LoopParameters<double>& loop, double slope, int n) {
  const Acoustics<double>& a = loop.acoustics;
  const Eigen::MatrixXd d = (2.0 / loop.tau_s) * ChebyshevDifferentiation(n);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(4 + n, 4 + n);
  Eigen::RowVectorXd boundary = Eigen::RowVectorXd::Zero(4 + n);  // w(0) = C x + (N + M) k w(-tau)
  const double coefficients[] = {a.N, a.M};
  for (int m = 0; m < 2; ++m) {
    const double w = kRadPerSPerHz * a.omega_hz * (m == 0 ? 1.0 : a.harmonic_ratio);
    const int y = 2 * m;
    const int p = y + 1;
    g(y, p) = w;
    g(p, y) = boundary(y) = -w;
    g(p, p) = boundary(p) = -2.0 * a.xi * w;
    g(p, 3 + n) = coefficients[m] * slope;
    boundary(3 + n) += coefficients[m] * slope;
  }
  for (int i = 1; i <= n; ++i) {
    g.row(3 + i).tail(n) += d.row(i).tail(n);
    g.row(3 + i) += d(i, 0) * boundary;
  }
  return g;
}

std::optional<Complex64> Newton(const LoopParameters<double>& loop, double slope, Complex64 s) {
  for (int i = 0; i < 40; ++i) {
    const ModeTransfer l = LoopTransfer(loop, s);
    // On log(k L) = 0: nearly linear in s, the delay dominating.
    Complex64 step = std::log(slope * l.value) * l.value / l.derivative;
    if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) return std::nullopt;
    constexpr double kLongest = 0.2;
    if (std::abs(step) > kLongest) step *= kLongest / std::abs(step);
    s -= step;
    if (std::abs(step) < 1e-14) {
      const bool solved = std::abs(slope * LoopTransfer(loop, s).value - 1.0) < 1e-8;
      return solved ? std::optional(s) : std::nullopt;
    }
  }
  return std::nullopt;
}

// Change of the characteristic's argument from a to b along a straight line.
double ArgumentChange(const LoopParameters<double>& loop, double slope, Complex64 a, Complex64 fa,
                      Complex64 b, Complex64 fb, int depth) {
  const Complex64 middle = 0.5 * (a + b);
  const Complex64 fm = Characteristic(loop, slope, middle);
  const double whole = std::arg(fb / fa);
  const double left = std::arg(fm / fa);
  const double right = std::arg(fb / fm);
  const bool smooth = std::abs(left) < 0.3 && std::abs(right) < 0.3 &&
                      std::abs(left + right - whole) < 1e-9 && std::abs(left - right) < 0.1;
  if (smooth || depth == 0) return left + right;
  return ArgumentChange(loop, slope, a, fa, middle, fm, depth - 1) +
         ArgumentChange(loop, slope, middle, fm, b, fb, depth - 1);
}

// Zeros with growth_min <= Re s <= growth_max and |Im s| <= w_max.
int CountZeros(const LoopParameters<double>& loop, double slope, double growth_min,
               double growth_max, double w_max) {
  const Complex64 corners[] = {
      {growth_min, 0.0}, {growth_max, 0.0}, {growth_max, w_max}, {growth_min, w_max}};
  // The characteristic is real on the real axis, so that the upper half of the contour gives half
  // of the turns.
  double change = 0.0;
  for (int side = 1; side < 4; ++side) {
    const Complex64 from = corners[side];
    const Complex64 to = corners[(side + 1) % 4];
    const int pieces = 16 + static_cast<int>(std::abs(to - from) * loop.tau_s * 4.0);
    Complex64 a = from;
    Complex64 fa = Characteristic(loop, slope, a);
    for (int i = 1; i <= pieces; ++i) {
      const Complex64 b = from + (to - from) * (static_cast<double>(i) / pieces);
      const Complex64 fb = Characteristic(loop, slope, b);
      change += ArgumentChange(loop, slope, a, fa, b, fb, 40);
      a = b;
      fa = fb;
    }
  }
  return static_cast<int>(std::lround(change / std::numbers::pi));
}

}  // namespace

PoleSet ClosedLoopPoles(const LoopParameters<double>& loop_in_s, double slope_in_s,
                        const PoleOptions& options) {
  CHECK_GT(loop_in_s.tau_s, 0.0);
  CHECK_NE(slope_in_s, 0.0);
  const double w = kRadPerSPerHz * loop_in_s.acoustics.omega_hz;
  const LoopParameters<double> loop = InUnitsOfW(loop_in_s, w);
  const double flame_slope = slope_in_s * w;
  const double w_max = options.frequency_max;
  const double growth_min = options.growth_min;
  const double bound = std::max(GrowthBound(loop, flame_slope), growth_min + kBeyond);
  const int zeros = CountZeros(loop, flame_slope, growth_min, bound, w_max);

  PoleSet set;
  // A polynomial resolves e^(j w theta) over tau once it has pi points a wave or so.
  int n = 24 + static_cast<int>(w_max * loop.tau_s);
  for (int attempt = 0; attempt < 3; ++attempt, n += n / 2) {
    const Eigen::VectorXcd eigenvalues = Generator(loop, flame_slope, n).eigenvalues();
    std::vector<Complex64> found;
    for (const Complex64& start : eigenvalues) {
      if (start.imag() < -1e-6 || start.imag() > 1.1 * w_max || start.real() < growth_min - 1.0) {
        continue;
      }
      const std::optional<Complex64> s = Newton(loop, flame_slope, start);
      if (!s || s->real() < growth_min || s->imag() > w_max || s->imag() < -1e-9) {
        continue;
      }
      const bool known = std::any_of(found.begin(), found.end(), [&](const Complex64& other) {
        return std::abs(other - *s) < 1e-9;
      });
      if (!known) found.push_back(*s);
    }
    std::sort(found.begin(), found.end(),
              [](const Complex64& l, const Complex64& r) { return l.real() > r.real(); });
    set.poles.clear();
    int listed = 0;
    int real = 0;
    for (const Complex64& s : found) {
      const bool is_real = std::abs(s.imag()) < 1e-9;
      set.poles.push_back({w * s.real(), is_real ? 0.0 : s.imag() * loop_in_s.acoustics.omega_hz});
      listed += is_real ? 1 : 2;
      real += is_real ? 1 : 0;
    }
    set.counted = (zeros - real) / 2 + real;
    set.complete = listed == zeros;
    if (set.complete) break;
  }
  return set;
}

Pole RightmostPole(const LoopParameters<double>& loop, double flame_slope, double frequency_max) {
  constexpr double kDeepest = -1e3;
  for (double growth_min = PoleOptions().growth_min; growth_min > kDeepest; growth_min *= 4.0) {
    const PoleSet set = ClosedLoopPoles(loop, flame_slope, {growth_min, frequency_max});
    if (!set.poles.empty()) return set.poles.front();
  }
  LOG(FATAL) << "no pole up to " << frequency_max << " times omega";
}

}  // namespace howl
