// Acoustics of the combustor, from heat release q to pressure p (the paper, section 3.3):
//
//   G(s) = N s / (s^2 + 2 omega xi s + omega^2)  +  M s / (s^2 + 2 (r omega) xi s + (r omega)^2)
//
// omega: natural frequency of the first mode; xi: damping ratio, shared by both modes; N, M: the
// modes' coefficients in (units of p per unit of q) * rad/s; r: ratio of the second mode's natural
// frequency to the first's (3 in the paper: the third mode of a half-open duct). M = 0 is the
// one-mode model.
//
// "The paper" is, in every header, Savaresi, Bitmead and Dunstan (2001), Non-linear system
// identification using closed-loop data with no external excitation: the case of a lean combustion
// chamber. Its experiment is test R228.
//
// Every function is a template on the scalar: double, ceres::Jet, or an interval.
#ifndef HOWL_MODEL_LOOP_ACOUSTICS_H_
#define HOWL_MODEL_LOOP_ACOUSTICS_H_

#include "model/numerics/complex.h"
#include "model/numerics/units.h"

namespace howl {

inline constexpr double kPaperHarmonicRatio = 3.0;

template <typename T>
struct Acoustics {
  T omega_hz;
  T xi;
  T N;
  T M;
  T harmonic_ratio;
};

// s / (s^2 + 2 omega xi s + omega^2) at s = j w; omega and w in rad/s. The result is in s/rad.
//
// Written as 1 / (2 omega xi + j (w - omega^2 / w)): one quotient, and each variable appears as
// seldom as possible, which keeps interval results tight.
template <typename T>
Complex<T> UnitModeResponse(const T& omega_rad_s, const T& xi, const T& w_rad_s) {
  const Complex<T> denominator{T(2.0) * omega_rad_s * xi,
                               w_rad_s - omega_rad_s * omega_rad_s / w_rad_s};
  const T scale = T(1.0) / SquaredMagnitude(denominator);
  return {denominator.re * scale, -denominator.im * scale};
}

// First mode alone: the paper's reduced form (5b).
template <typename T>
Complex<T> FirstModeResponse(const Acoustics<T>& acoustics, const T& frequency_hz) {
  return acoustics.N * UnitModeResponse(T(kRadPerSPerHz) * acoustics.omega_hz, acoustics.xi,
                                        T(kRadPerSPerHz) * frequency_hz);
}

// G(j 2 pi f), both modes: the paper's full form (5a).
template <typename T>
Complex<T> AcousticResponse(const Acoustics<T>& acoustics, const T& frequency_hz) {
  const T second_omega_rad_s = T(kRadPerSPerHz) * acoustics.harmonic_ratio * acoustics.omega_hz;
  return FirstModeResponse(acoustics, frequency_hz) +
         acoustics.M *
             UnitModeResponse(second_omega_rad_s, acoustics.xi, T(kRadPerSPerHz) * frequency_hz);
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_ACOUSTICS_H_
