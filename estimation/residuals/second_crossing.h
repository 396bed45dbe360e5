// A second frequency at which the loop can oscillate (section 4): the phase of L at an observed
// non-harmonic line is 180 degrees, modulo 360, as at the limit cycle. The residual is that of
// limit_cycle_phase.h, with a standard deviation that also carries the line's own:
//
//   std^2 = std_deg^2 + (360 tau std_f)^2
//
// because near the line the delay turns the phase by 360 tau degrees per hertz. tau_s: equation
// (3).
#ifndef HOWL_ESTIMATION_RESIDUALS_SECOND_CROSSING_H_
#define HOWL_ESTIMATION_RESIDUALS_SECOND_CROSSING_H_

#include "estimation/residuals/limit_cycle_phase.h"

namespace howl {

inline LimitCyclePhase SecondCrossing(double line_hz, double line_std_hz, double tau_s,
                                      double std_deg) {
  return {line_hz, std::hypot(std_deg, 360.0 * tau_s * line_std_hz)};
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_SECOND_CROSSING_H_
