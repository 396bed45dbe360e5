// Which column is pressure and which heat release: by names where there are names, else by values.
//
// Pressure is measured about a mean that the transducer, or its amplifier, takes away; the light of
// a flame is never negative, so that q keeps its mean. With r = |mean| / standard deviation, the
// median over all files of one layout: q has the larger r. On the public turbulent combustor (IIT
// Madras, 13 operating points, from noise to a strong cycle) r is 1.46 to 5.0 for the
// photomultiplier and 0.02 to 0.34 for pressure: hence the two thresholds.
#ifndef HOWL_IO_INSPECT_ROLE_GUESS_H_
#define HOWL_IO_INSPECT_ROLE_GUESS_H_

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "io/inspect/record_look.h"

namespace howl {

inline constexpr double kKeepsMean = 1.0;
inline constexpr double kHasNoMean = 0.5;

struct RoleGuess {
  std::optional<std::size_t> pressure;  // absent: no column is left for it
  std::string pressure_reason;
  std::optional<std::size_t> heat_release;
  std::string heat_release_reason;
  bool is_sure = true;  // false: the reason is weak, and says so
};

// `looks`: at least one, all of one layout.
RoleGuess GuessRoles(std::span<const RecordLook* const> looks);

}  // namespace howl

#endif  // HOWL_IO_INSPECT_ROLE_GUESS_H_
