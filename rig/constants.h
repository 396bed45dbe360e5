// Numbers that have a name everywhere.
#ifndef HOWL_RIG_CONSTANTS_H_
#define HOWL_RIG_CONSTANTS_H_

#include <numbers>

namespace rig {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

}  // namespace rig

#endif  // HOWL_RIG_CONSTANTS_H_
