// The loop's phase is 180 degrees at a frequency where the rig oscillates, (1a):
//
//   residual = (arg L(j 2 pi f) - 180 degrees) / std,   wrapped to half a turn
//
// At the limit-cycle frequency this is condition (1a). At an observed non-harmonic line it is the
// second crossing of section 4: see second_crossing.h. std_deg: standard deviation, degrees.
#ifndef HOWL_ESTIMATION_RESIDUALS_LIMIT_CYCLE_PHASE_H_
#define HOWL_ESTIMATION_RESIDUALS_LIMIT_CYCLE_PHASE_H_

#include "estimation/residuals/acoustic_residual.h"

namespace howl {

struct LimitCyclePhase {
  template <typename T>
  T Residual(const LoopParameters<T>& loop) const {
    return T(kDegPerRad / std_deg) * LoopPhaseError(loop, T(frequency_hz));
  }

  double frequency_hz;
  double std_deg;
};

using LimitCyclePhaseResidual = LoopResidual<LimitCyclePhase>;

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_LIMIT_CYCLE_PHASE_H_
