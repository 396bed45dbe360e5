// What the second mode adds to the response, relative to the first:
//
//   share(f) = |M U_r(j 2 pi f)| / |N U_1(j 2 pi f)|
//
// The paper neglects the second mode at the limit cycle, (5b): there the share is small. With
// y = sinh(ln(f / omega)) and y_r = sinh(ln(f / (r omega))) it is
//
//   M / (r N) sqrt((xi^2 + y^2) / (xi^2 + y_r^2)).
//
// No unit; frequency_hz in Hz.
#ifndef HOWL_MODEL_LOOP_SECOND_MODE_H_
#define HOWL_MODEL_LOOP_SECOND_MODE_H_

#include "model/loop/acoustics.h"

namespace howl {

template <typename T>
T SecondModeShare(const Acoustics<T>& acoustics, const T& frequency_hz) {
  using std::sqrt;
  const T omega_rad_s = T(kRadPerSPerHz) * acoustics.omega_hz;
  const T w_rad_s = T(kRadPerSPerHz) * frequency_hz;
  const T first = SquaredMagnitude(UnitModeResponse(omega_rad_s, acoustics.xi, w_rad_s));
  const T second = SquaredMagnitude(
      UnitModeResponse(acoustics.harmonic_ratio * omega_rad_s, acoustics.xi, w_rad_s));
  return acoustics.M / acoustics.N * sqrt(second / first);
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_SECOND_MODE_H_
