// Numbers that have a name everywhere.
#ifndef HOWL_MODEL_NUMERICS_CONSTANTS_H_
#define HOWL_MODEL_NUMERICS_CONSTANTS_H_

#include <limits>
#include <numbers>

namespace howl {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;
inline constexpr double kPerCent = 100.0;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_CONSTANTS_H_
