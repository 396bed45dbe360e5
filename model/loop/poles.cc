#include "model/loop/poles.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "model/loop/laplace.h"
#include "model/numerics/chebyshev.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

using Complex64 = std::complex<double>;

// D1 D2 (1 - k L): entire, with the poles sought as its only zeros; of one mode D1 (1 - k L), for
// D2's zeros are not the loop's then. Scaled by omega^4, and left of the imaginary axis by
// |e^(tau s)| as well, which grows without end there: what is asked of it is its argument.
Complex64 Characteristic(const LoopParameters<double>& loop, double slope, Complex64 s) {
  const Acoustics<double>& a = loop.acoustics;
  const double w1 = kRadPerSPerHz * a.omega_hz;
  const double w2 = a.harmonic_ratio * w1;
  const Complex64 d1 = (s * s + 2.0 * w1 * a.xi * s + w1 * w1) / (w1 * w1);
  const Complex64 d2 = a.M == 0.0 ? 1.0 : (s * s + 2.0 * w2 * a.xi * s + w2 * w2) / (w1 * w1);
  const Complex64 z = s * s / (w1 * w1);
  const Complex64 flame = slope * z * (a.N * d2 + a.M * d1);
  if (s.real() >= 0.0) return d1 * d2 - flame * std::exp(-loop.tau_s * s);
  return d1 * d2 * std::exp(loop.tau_s * s.real()) -
         flame * std::polar(1.0, -loop.tau_s * s.imag());
}

// Beyond a bound, so that no zero lies on the contour.
constexpr double kBeyond = 1e-3;  // of w

constexpr int kCellsOfTurn = 8;  // of the delay's turns by one radian

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

// Newton on the characteristic itself, for where the loop hardly feels its flame, or feels it so
// much that the eigenvalues are no starts. Without a second mode, whose factor D2 is none of the
// loop's.
std::optional<Complex64> NewtonOnCharacteristic(const LoopParameters<double>& loop, double slope,
                                                Complex64 s) {
  const Acoustics<double>& a = loop.acoustics;
  const double r = a.M == 0.0 ? 1.0 : a.harmonic_ratio;
  for (int i = 0; i < 100; ++i) {
    const Complex64 d1 = s * s + 2.0 * a.xi * s + 1.0;
    const Complex64 d1_rate = 2.0 * (s + a.xi);
    const Complex64 d2 = a.M == 0.0 ? 1.0 : s * s + 2.0 * r * a.xi * s + r * r;
    const Complex64 d2_rate = a.M == 0.0 ? 0.0 : 2.0 * (s + r * a.xi);
    const Complex64 modes = a.N * d2 + (a.M == 0.0 ? 0.0 : a.M * d1);
    const Complex64 modes_rate = a.N * d2_rate + (a.M == 0.0 ? 0.0 : a.M * d1_rate);
    const Complex64 flame = slope * std::exp(-loop.tau_s * s);
    const Complex64 value = d1 * d2 - flame * s * s * modes;
    const Complex64 rate =
        d1_rate * d2 + d1 * d2_rate -
        flame * (2.0 * s * modes + s * s * modes_rate - loop.tau_s * s * s * modes);
    Complex64 step = value / rate;
    if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) return std::nullopt;
    const double size = 1.0 + std::abs(s);
    if (std::abs(step) > 0.2 * size) step *= 0.2 * size / std::abs(step);
    s -= step;
    if (std::abs(step) < 1e-13 * size) return s;
  }
  return std::nullopt;
}

// Where the poles tend to as the flame's slope vanishes (the modes') and as it grows without end
// (the delay's: k (N + M) e^(-tau s) = 1).
std::vector<Complex64> LimitingPoles(const LoopParameters<double>& loop, double slope,
                                     double w_max) {
  const Acoustics<double>& a = loop.acoustics;
  std::vector<Complex64> poles;
  for (const double r : {1.0, a.harmonic_ratio}) {
    if (r != 1.0 && a.M == 0.0) continue;
    const Complex64 root = r * std::sqrt(Complex64(a.xi * a.xi - 1.0));
    poles.push_back(-a.xi * r + root);
    if (a.xi >= 1.0) poles.push_back(-a.xi * r - root);
  }
  const double growth = std::log(std::abs(slope) * (a.N + a.M)) / loop.tau_s;
  const double first = slope < 0.0 ? std::numbers::pi : 0.0;
  for (double angle = first; angle <= w_max * loop.tau_s; angle += 2.0 * std::numbers::pi) {
    poles.emplace_back(growth, angle / loop.tau_s);
  }
  return poles;
}

// Where on the imaginary axis the loop's phase lets it oscillate: near there is a pole, however
// fast it grows or decays, as long as the delay turns the phase faster than growth does.
std::vector<Complex64> PhaseCrossingsOf(const LoopParameters<double>& loop, double slope,
                                        double w_max) {
  const int cells = kCellsOfTurn * (4 + static_cast<int>(w_max * loop.tau_s));
  std::vector<Complex64> crossings;
  double before = 0.0;
  for (int i = 1; i <= cells; ++i) {
    const double w = w_max * i / cells;
    const double phase = std::arg(slope * LoopTransfer(loop, Complex64(0.0, w)).value);
    // Through zero, not through the branch cut at half a turn.
    if (i > 1 && (phase <= 0.0) != (before <= 0.0) && std::abs(phase - before) < 3.0) {
      const double share = before / (before - phase);
      crossings.emplace_back(0.0, w_max * (i - 1 + share) / cells);
    }
    before = phase;
  }
  return crossings;
}

// Change of the characteristic's argument from a to b along a straight line.
double ArgumentChange(const LoopParameters<double>& loop, double slope, Complex64 a, Complex64 fa,
                      Complex64 b, Complex64 fb, int depth) {
  const Complex64 middle = 0.5 * (a + b);
  const Complex64 fm = Characteristic(loop, slope, middle);
  const double whole = std::arg(fb / fa);
  const double left = std::arg(fm / fa);
  const double right = std::arg(fb / fm);
  if (!std::isfinite(whole)) return 0.0;  // no halving mends what overflows
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

// Without a flame the loop is open, and its poles are its modes': of these the first decays
// slowest.
Pole OpenPole(const Acoustics<double>& a) {
  const double w = kRadPerSPerHz * a.omega_hz;
  if (a.xi < 1.0) return {-a.xi * w, a.omega_hz * std::sqrt(1.0 - a.xi * a.xi)};
  return {-w / (a.xi + std::sqrt(a.xi * a.xi - 1.0)), 0.0};
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

  std::vector<Complex64> found;
  const auto take = [&](const std::optional<Complex64>& s) {
    if (!s || s->real() < growth_min || s->imag() > w_max || s->imag() < -1e-9) return;
    const bool known = std::any_of(found.begin(), found.end(), [&](const Complex64& other) {
      return std::abs(other - *s) < 1e-9;
    });
    if (!known) found.push_back(*s);
  };
  PoleSet set;
  const auto list = [&] {
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
  };
  const auto take_limiting = [&] {
    for (const Complex64& start : LimitingPoles(loop, flame_slope, w_max)) {
      take(NewtonOnCharacteristic(loop, flame_slope, start));
    }
    list();
  };
  for (const Complex64& start : PhaseCrossingsOf(loop, flame_slope, 1.1 * w_max)) {
    take(Newton(loop, flame_slope, start));
  }
  take_limiting();
  // A polynomial resolves e^(j w theta) over tau once it has pi points a wave or so.
  int n = 24 + static_cast<int>(w_max * loop.tau_s);
  for (int attempt = 0; attempt < 3 && !set.complete; ++attempt, n += n / 2) {
    const Eigen::VectorXcd eigenvalues = Eigenvalues(Generator(loop, flame_slope, n));
    found.clear();
    for (const Complex64& start : eigenvalues) {
      if (start.imag() < -1e-6 || start.imag() > 1.1 * w_max || start.real() < growth_min - 1.0) {
        continue;
      }
      take(Newton(loop, flame_slope, start));
    }
    list();
  }
  if (!set.complete) take_limiting();
  return set;
}

std::optional<Pole> RightmostPole(const LoopParameters<double>& loop, double flame_slope,
                                  double frequency_max) {
  if (flame_slope == 0.0) return OpenPole(loop.acoustics);
  constexpr double kDeepest = -1e3;
  for (double growth_min = PoleOptions().growth_min; growth_min > kDeepest; growth_min *= 4.0) {
    const PoleSet set = ClosedLoopPoles(loop, flame_slope, {growth_min, frequency_max});
    if (!set.poles.empty()) return set.poles.front();
  }
  return std::nullopt;
}

}  // namespace howl
