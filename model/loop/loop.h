// The loop without its flame (the paper, (1a) and (1b), whose first term must read e^(-tau s)):
//
//   L(s) = s G(s) e^(-tau s)
//
// from heat release q to the delayed derivative of pressure that drives the flame. A limit cycle
// at f needs arg L(j 2 pi f) = 180 degrees, (1a), and |L(j 2 pi f) Phi'(0)| > 1, (1b), where
// Phi'(0) < 0 is the slope of the flame's saturating characteristic at zero.
#ifndef HOWL_MODEL_LOOP_LOOP_H_
#define HOWL_MODEL_LOOP_LOOP_H_

#include "model/loop/acoustics.h"
#include "model/loop/delay.h"

namespace howl {

template <typename T>
struct LoopParameters {
  Acoustics<T> acoustics;
  T tau_s;
};

// L(j 2 pi f), in (units of p per unit of q) * rad/s.
template <typename T>
Complex<T> LoopResponse(const LoopParameters<T>& loop, const T& frequency_hz) {
  const Complex<T> derivative{T(0.0), T(kRadPerSPerHz) * frequency_hz};
  return derivative * AcousticResponse(loop.acoustics, frequency_hz) *
         DelayResponse(loop.tau_s, frequency_hz);
}

// The loop's phase less 180 degrees, in (-pi, pi]: zero where (1a) holds.
template <typename T>
T LoopPhaseError(const LoopParameters<T>& loop, const T& frequency_hz) {
  const Complex<T> response = LoopResponse(loop, frequency_hz);
  return Angle(Complex<T>{-response.re, -response.im});
}

// |L(j 2 pi f) Phi'(0)|: the left side of (1b).
template <typename T>
T LoopGain(const LoopParameters<T>& loop, const T& frequency_hz, const T& flame_slope) {
  using std::abs;
  return Magnitude(LoopResponse(loop, frequency_hz)) * abs(flame_slope);
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_LOOP_H_
