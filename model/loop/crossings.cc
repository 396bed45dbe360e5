#include "model/loop/crossings.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "model/loop/loop_phase.h"
#include "model/numerics/constants.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

using internal::LoopPhase;
using internal::MakeLoopPhase;
using internal::PhaseRange;
using internal::Quadratic;

// The root of phase(w) = target in [a, b], on which the phase is monotonic: Newton inside a
// bracket.
double Polish(const LoopPhase& phase, double target, double a, double b) {
  const bool rising = phase.At(b) > phase.At(a);
  double w = 0.5 * (a + b);
  for (int i = 0; i < 200; ++i) {
    const double error = phase.At(w) - target;
    if (error == 0.0) break;
    ((error > 0.0) == rising ? b : a) = w;
    double next = w - error / phase.Rate(w);
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (std::abs(next - w) <= 1e-15 * w) return next;
    w = next;
  }
  return w;
}

struct Root {
  double w;
  int turns;
};

// Multiples of a turn in the phase's range: pi - 2 pi turns.
void Search(const LoopPhase& phase, double a, double b, std::vector<Root>* roots) {
  const PhaseRange bounds = phase.Bounds(a, b);
  const int fewest = static_cast<int>(std::ceil((kPi - bounds.hi) / kTwoPi));
  const int most = static_cast<int>(std::floor((kPi - bounds.lo) / kTwoPi));
  if (fewest > most) return;
  const PhaseRange rate = phase.RateBounds(a, b);
  if (rate.lo > 0.0 || rate.hi < 0.0) {
    for (int turns = fewest; turns <= most; ++turns) {
      const double target = kPi - kTwoPi * turns;
      const double left = phase.At(a) - target;
      const double right = phase.At(b) - target;
      // A root at a belongs to the interval before it.
      if (right == 0.0 || (left != 0.0 && (left < 0.0) != (right < 0.0))) {
        roots->push_back({Polish(phase, target, a, b), turns});
      }
    }
    return;
  }
  const double middle = 0.5 * (a + b);
  if (b - a < 1e-10 * b) {  // the phase touches the axis here, without or barely crossing it
    const int turns = static_cast<int>(std::lround((kPi - phase.At(middle)) / kTwoPi));
    if (std::abs(phase.At(middle) - kPi + kTwoPi * turns) < 1e-12)
      roots->push_back({middle, turns});
    return;
  }
  Search(phase, a, middle, roots);
  Search(phase, middle, b, roots);
}

}  // namespace

double UnwrappedLoopPhase(const LoopParameters<double>& loop, double frequency_hz) {
  return MakeLoopPhase(loop).At(kRadPerSPerHz * frequency_hz);
}

std::vector<PhaseCrossing> PhaseCrossings(const LoopParameters<double>& loop, double flame_slope,
                                          double frequency_max_hz) {
  const LoopPhase phase = MakeLoopPhase(loop);
  std::vector<Root> roots;
  // f = 0, where L = 0 has the phase pi, is no crossing. The first interval starts so low that the
  // phase cannot have turned before it.
  const double w_max = kRadPerSPerHz * frequency_max_hz;
  constexpr int kIntervals = 64;
  double a = 1e-9 * w_max;
  for (int i = 1; i <= kIntervals; ++i) {
    const double b = w_max * i / kIntervals;
    Search(phase, a, b, &roots);
    a = b;
  }
  std::sort(roots.begin(), roots.end(), [](const Root& l, const Root& r) { return l.w < r.w; });
  std::vector<PhaseCrossing> crossings;
  for (const Root& root : roots) {
    PhaseCrossing crossing;
    crossing.frequency_hz = root.w / kRadPerSPerHz;
    crossing.gain = LoopGain(loop, crossing.frequency_hz, flame_slope);
    crossing.gain_margin_db = -20.0 * std::log10(crossing.gain);
    crossing.phase_rate_deg_per_hz = kDegPerRad * kRadPerSPerHz * phase.Rate(root.w);
    crossing.turns = root.turns;
    crossings.push_back(crossing);
  }
  return crossings;
}

std::vector<GainCrossing> GainCrossings(const LoopParameters<double>& loop, double flame_slope,
                                        double frequency_max_hz) {
  const LoopPhase phase = MakeLoopPhase(loop);
  // k^2 x^2 |num|^2 = |first|^2 |second|^2 with x = (w / omega)^2, as polynomials in x.
  const double omega = kRadPerSPerHz * loop.acoustics.omega_hz;
  const auto square = [omega](const Quadratic& q) {
    const double c0 = q.c0 / (omega * omega);
    const double c1 = q.c1 / omega;
    return std::array<double, 3>{c0 * c0, c1 * c1 - 2.0 * c0 * q.c2, q.c2 * q.c2};
  };
  const std::array<double, 3> n = square(phase.numerator);
  const std::array<double, 3> f = square(phase.first);
  const std::array<double, 3> s = square(phase.second);
  std::array<double, 5> polynomial{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) polynomial[i + j] += f[i] * s[j];
    polynomial[i + 2] -= flame_slope * flame_slope * n[i];
  }
  // |Phi'(0)| (N + M) = 1 exactly makes the leading coefficient vanish: one root at infinity.
  int degree = 4;
  while (degree > 0 && polynomial[static_cast<std::size_t>(degree)] == 0.0) --degree;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
  for (int i = 0; i < degree; ++i) {
    companion(i, degree - 1) =
        -polynomial[static_cast<std::size_t>(i)] / polynomial[static_cast<std::size_t>(degree)];
    if (i > 0) companion(i, i - 1) = 1.0;
  }
  std::vector<GainCrossing> crossings;
  if (degree == 0) return crossings;
  const Eigen::VectorXcd roots = Eigenvalues(companion);
  for (const std::complex<double>& root : roots) {
    if (root.real() <= 0.0 || std::abs(root.imag()) > 1e-9 * std::abs(root)) continue;
    double x = root.real();
    for (int i = 0; i < 3; ++i) {
      double value = 0.0;
      double slope = 0.0;
      for (std::size_t k = polynomial.size(); k-- > 0;) {
        slope = slope * x + value;
        value = value * x + polynomial[k];
      }
      if (slope != 0.0 && std::abs(value / slope) < 1e-6 * x) x -= value / slope;
    }
    const double frequency_hz = loop.acoustics.omega_hz * std::sqrt(x);
    if (frequency_hz > frequency_max_hz) continue;
    const double error = LoopPhaseError(loop, frequency_hz);  // the lag that remains
    const double lag = error < 0.0 ? error + kTwoPi : error;
    crossings.push_back({frequency_hz, kDegPerRad * error, lag / (kTwoPi * frequency_hz)});
  }
  std::sort(crossings.begin(), crossings.end(), [](const GainCrossing& l, const GainCrossing& r) {
    return l.frequency_hz < r.frequency_hz;
  });
  return crossings;
}

LoopMargins Margins(const LoopParameters<double>& loop, double flame_slope,
                    double frequency_max_hz) {
  LoopMargins margins{kInfinity, kInfinity, kInfinity, false};
  const auto crossings = PhaseCrossings(loop, flame_slope, frequency_max_hz);
  for (const PhaseCrossing& crossing : crossings) {
    margins.gain_margin_db = std::min(margins.gain_margin_db, crossing.gain_margin_db);
  }
  for (const GainCrossing& crossing : GainCrossings(loop, flame_slope, frequency_max_hz)) {
    if (std::abs(crossing.phase_margin_deg) < std::abs(margins.phase_margin_deg)) {
      margins.phase_margin_deg = crossing.phase_margin_deg;
    }
    margins.delay_margin_s = std::min(margins.delay_margin_s, crossing.delay_margin_s);
  }
  margins.stable = UnstablePairs(crossings) == 0;
  return margins;
}

int UnstablePairs(const std::vector<PhaseCrossing>& crossings) {
  int pairs = 0;
  for (const PhaseCrossing& crossing : crossings) {
    if (crossing.gain > 1.0) pairs += crossing.phase_rate_deg_per_hz < 0.0 ? 1 : -1;
  }
  return pairs;
}

std::vector<NyquistPoint> NyquistCurve(const LoopParameters<double>& loop, double flame_slope,
                                       double frequency_max_hz, double max_angle_deg) {
  const LoopPhase phase = MakeLoopPhase(loop);
  std::vector<NyquistPoint> curve;
  double f = 0.0;
  const double largest = frequency_max_hz / 64.0;
  while (f < frequency_max_hz) {
    // The rate of the phase is bounded over the step, not only at its start.
    double step = std::min(largest, frequency_max_hz - f);
    for (;;) {
      const PhaseRange rate = phase.RateBounds(kRadPerSPerHz * f, kRadPerSPerHz * (f + step));
      const double fastest = std::max(std::abs(rate.lo), std::abs(rate.hi));
      if (fastest * kRadPerSPerHz * step <= max_angle_deg * kRadPerDeg) break;
      step *= 0.5;
    }
    f = frequency_max_hz - f - step < 1e-12 * frequency_max_hz ? frequency_max_hz : f + step;
    const Complex<double> response = LoopResponse(loop, f);
    curve.push_back({f, std::abs(flame_slope) * std::complex<double>(response.re, response.im)});
  }
  return curve;
}

}  // namespace howl
