// The loop's phase without jumps, and bounds on it and its rate over intervals.
//
//   arg L(j w) = pi + arg n(j w) - arg d_1(j w) - arg d_2(j w) - w tau
//   n = (N + M) s^2 + 2 xi (N w_2 + M w_1) s + N w_2^2 + M w_1^2,   d_i = s^2 + 2 xi w_i s + w_i^2
//
// with w_1 = omega, w_2 = r omega.
//
// With N, M >= 0 all coefficients are positive, and each phase grows with w from 0 to pi. w in
// rad/s, phases in rad.
#ifndef HOWL_MODEL_LOOP_LOOP_PHASE_H_
#define HOWL_MODEL_LOOP_LOOP_PHASE_H_

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/loop/loop.h"

namespace howl::internal {

struct PhaseRange {
  double lo;
  double hi;
};

// Phase in [0, pi] of c0 - c2 w^2 + j c1 w, all coefficients positive: grows with w.
struct Quadratic {
  double c0;
  double c1;
  double c2;

  double Phase(double w) const { return std::atan2(c1 * w, c0 - c2 * w * w); }
  double Rate(double w) const {
    const double re = c0 - c2 * w * w;
    const double im = c1 * w;
    return c1 * (c0 + c2 * w * w) / (re * re + im * im);
  }
  // Of the rate over [a, b]: it rises to one peak and falls. With x = w^2 c2 / c0 and
  // k = c1^2 / (c0 c2) the peak is at x = sqrt(4 - k) - 1, or at zero.
  PhaseRange RateRange(double a, double b) const {
    const double k = c1 * c1 / (c0 * c2);
    const double x = k < 3.0 ? std::sqrt(4.0 - k) - 1.0 : 0.0;
    const double peak = std::sqrt(x * c0 / c2);
    const double at_a = Rate(a);
    const double at_b = Rate(b);
    return {std::min(at_a, at_b), peak > a && peak < b ? Rate(peak) : std::max(at_a, at_b)};
  }
};

struct LoopPhase {
  Quadratic numerator;
  Quadratic first;
  Quadratic second;
  double tau;

  double At(double w) const {
    return std::numbers::pi + numerator.Phase(w) - first.Phase(w) - second.Phase(w) - tau * w;
  }
  double Rate(double w) const { return numerator.Rate(w) - first.Rate(w) - second.Rate(w) - tau; }
  PhaseRange Bounds(double a, double b) const {
    return {std::numbers::pi + numerator.Phase(a) - first.Phase(b) - second.Phase(b) - tau * b,
            std::numbers::pi + numerator.Phase(b) - first.Phase(a) - second.Phase(a) - tau * a};
  }
  PhaseRange RateBounds(double a, double b) const {
    const PhaseRange n = numerator.RateRange(a, b);
    const PhaseRange f = first.RateRange(a, b);
    const PhaseRange s = second.RateRange(a, b);
    return {n.lo - f.hi - s.hi - tau, n.hi - f.lo - s.lo - tau};
  }
};

inline LoopPhase MakeLoopPhase(const LoopParameters<double>& loop) {
  const Acoustics<double>& a = loop.acoustics;
  CHECK(a.N >= 0.0 && a.M >= 0.0 && a.N + a.M > 0.0) << "N " << a.N << ", M " << a.M;
  CHECK(a.omega_hz > 0.0 && a.xi > 0.0 && a.harmonic_ratio > 0.0 && loop.tau_s >= 0.0);
  const double w1 = kRadPerSPerHz * a.omega_hz;
  const double w2 = a.harmonic_ratio * w1;
  return {{a.N * w2 * w2 + a.M * w1 * w1, 2.0 * a.xi * (a.N * w2 + a.M * w1), a.N + a.M},
          {w1 * w1, 2.0 * a.xi * w1, 1.0},
          {w2 * w2, 2.0 * a.xi * w2, 1.0},
          loop.tau_s};
}

}  // namespace howl::internal

#endif  // HOWL_MODEL_LOOP_LOOP_PHASE_H_
