// A limit cycle needs a loop that is unstable at rest, (1b): |L(j 2 pi f) Phi'(0)| > 1. One-sided:
//
//   residual = max(0, 1 - |L Phi'(0)|) / std
//
// flame_slope: Phi'(0), data (the paper's table 3). std: standard deviation of the loop gain.
#ifndef HOWL_ESTIMATION_RESIDUALS_LIMIT_CYCLE_GAIN_H_
#define HOWL_ESTIMATION_RESIDUALS_LIMIT_CYCLE_GAIN_H_

#include "estimation/residuals/acoustic_residual.h"

namespace howl {

struct LimitCycleGain {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    const double slope_times_w = std::abs(flame_slope) * kRadPerSPerHz * frequency_hz;
    const T shortfall =
        T(1.0) - T(slope_times_w) * Magnitude(AcousticResponse(acoustics, T(frequency_hz)));
    return shortfall > T(0.0) ? shortfall / T(std) : T(0.0);
  }

  double frequency_hz;
  double flame_slope;
  double std;
};

using LimitCycleGainResidual = AcousticResidual<LimitCycleGain>;

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_LIMIT_CYCLE_GAIN_H_
