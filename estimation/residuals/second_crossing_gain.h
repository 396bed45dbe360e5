// A line appears where the loop's phase crosses 180 degrees a second time "with magnitude greater
// than one" (section 4), which is (1b) at the line. The residual is one-sided, as in
// limit_cycle_gain.h:
//
//   residual = max(0, 1 - |L(j 2 pi f_line) Phi'(0)|) / std
#ifndef HOWL_ESTIMATION_RESIDUALS_SECOND_CROSSING_GAIN_H_
#define HOWL_ESTIMATION_RESIDUALS_SECOND_CROSSING_GAIN_H_

#include "estimation/residuals/limit_cycle_gain.h"

namespace howl {

inline LimitCycleGain SecondCrossingGain(double line_hz, double flame_slope, double std) {
  return {line_hz, flame_slope, std};
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_SECOND_CROSSING_GAIN_H_
