// The loop at any complex s = sigma + j w (the paper, (1a), (1b)), s in rad/s:
//
//   L(s) = s G(s) e^(-tau s),
//   s G(s) = N s^2 / (s^2 + 2 omega xi s + omega^2) + M s^2 / (s^2 + 2 r omega xi s + (r omega)^2)
//
// L does not vanish at high frequency but tends to (N + M) e^(-tau s): a delay equation of neutral
// type. With |Phi'(0)| (N + M) < 1 its poles of high frequency tend to the line
// Re s = ln(|Phi'(0)| (N + M)) / tau < 0; with more than one, none of them is stable.
#ifndef HOWL_MODEL_LOOP_LAPLACE_H_
#define HOWL_MODEL_LOOP_LAPLACE_H_

#include <complex>

#include "model/loop/flame.h"
#include "model/loop/loop.h"

namespace howl {

// The loop closed by its flame: q = Phi(p'(t - tau)), p = G q.
struct ClosedLoop {
  LoopParameters<double> loop;
  Flame<double> flame;
};

struct ModeTransfer {
  std::complex<double> value;       // c s^2 / D(s)
  std::complex<double> derivative;  // d/ds
};

inline ModeTransfer ModeRateTransfer(double omega_rad_s, double xi, double coefficient,
                                     std::complex<double> s) {
  const std::complex<double> d = s * s + 2.0 * omega_rad_s * xi * s + omega_rad_s * omega_rad_s;
  const std::complex<double> value = coefficient * s * s / d;
  return {value,
          coefficient * (2.0 * s * d - s * s * (2.0 * s + 2.0 * omega_rad_s * xi)) / (d * d)};
}

// s G(s), from q to the rate of change of p.
inline std::complex<double> RateTransfer(const Acoustics<double>& a, std::complex<double> s) {
  const double omega = kRadPerSPerHz * a.omega_hz;
  return ModeRateTransfer(omega, a.xi, a.N, s).value +
         ModeRateTransfer(a.harmonic_ratio * omega, a.xi, a.M, s).value;
}

// L(s) and dL/ds.
inline ModeTransfer LoopTransfer(const LoopParameters<double>& loop, std::complex<double> s) {
  const Acoustics<double>& a = loop.acoustics;
  const double omega = kRadPerSPerHz * a.omega_hz;
  const ModeTransfer first = ModeRateTransfer(omega, a.xi, a.N, s);
  const ModeTransfer second = ModeRateTransfer(a.harmonic_ratio * omega, a.xi, a.M, s);
  const std::complex<double> delay = std::exp(-loop.tau_s * s);
  const std::complex<double> rate = first.value + second.value;
  return {rate * delay, (first.derivative + second.derivative - loop.tau_s * rate) * delay};
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_LAPLACE_H_
