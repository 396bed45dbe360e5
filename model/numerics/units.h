// Conversions between the units of configs and files (Hz, degrees) and those of the equations
// (rad/s, radians).
#ifndef HOWL_MODEL_NUMERICS_UNITS_H_
#define HOWL_MODEL_NUMERICS_UNITS_H_

#include <cmath>
#include <numbers>

namespace howl {

inline constexpr double kRadPerSPerHz = 2.0 * std::numbers::pi;
inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;

// The angle's equal in (-180, 180].
inline double WrapDeg(double angle_deg) {
  const double wrapped = std::remainder(angle_deg, 360.0);
  return wrapped == -180.0 ? 180.0 : wrapped;
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_UNITS_H_
