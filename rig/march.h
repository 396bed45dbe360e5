// The loop in time, on a grid that is finer than the record's: the duct's sums are exact for what
// the grid resolves, p' is read tau earlier by a polynomial through six neighbours (delay_line.h).
#ifndef HOWL_RIG_MARCH_H_
#define HOWL_RIG_MARCH_H_

#include <cstdint>
#include <vector>

#include "rig/plan.h"

namespace rig {

struct Grid {
  double step_s = 0.0;
  std::size_t per_sample = 1;  // grid steps in a sample of the record
};

// About 47 steps in the duct's round trip, times `refine`.
Grid MakeGrid(const Plan& plan, double sampling_hz, int refine);

struct TrueSignals {
  std::vector<double> p;
  std::vector<double> q;
};

// The `steps` steps after the first `settle`, which are thrown away. Throws std::runtime_error
// where the loop runs away.
TrueSignals March(const Plan& plan, std::size_t point, const Grid& grid, std::size_t settle,
                  std::size_t steps, std::uint64_t seed);

}  // namespace rig

#endif  // HOWL_RIG_MARCH_H_
