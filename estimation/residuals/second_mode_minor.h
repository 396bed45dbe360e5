// At the limit cycle the second mode can be neglected, (5b). One-sided:
//
//   residual = max(0, |M U_r(j 2 pi f)| / |N U_1(j 2 pi f)| - share_max) / std
//
// share_max: the share up to which the second mode hardly matters; std: standard deviation of the
// share.
#ifndef HOWL_ESTIMATION_RESIDUALS_SECOND_MODE_MINOR_H_
#define HOWL_ESTIMATION_RESIDUALS_SECOND_MODE_MINOR_H_

#include "estimation/residuals/acoustic_residual.h"
#include "model/second_mode.h"

namespace howl {

struct SecondModeMinor {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    const T excess = SecondModeShare(acoustics, T(frequency_hz)) - T(share_max);
    return excess > T(0.0) ? excess / T(std) : T(0.0);
  }

  double frequency_hz;
  double share_max;
  double std;
};

using SecondModeMinorResidual = AcousticResidual<SecondModeMinor>;

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_SECOND_MODE_MINOR_H_
