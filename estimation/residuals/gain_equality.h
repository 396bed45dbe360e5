// |G(j 2 pi f)| = A_p / A_q at the limit-cycle frequency f: first line of (5a), or of (5c).
//
//   residual = log(|G| / gain) / std_relative
//
// gain: measured, in units of p per unit of q. std_relative: standard deviation of the measured
// gain over the gain. The logarithm makes the residual linear in log N.
#ifndef HOWL_ESTIMATION_RESIDUALS_GAIN_EQUALITY_H_
#define HOWL_ESTIMATION_RESIDUALS_GAIN_EQUALITY_H_

#include "estimation/residuals/acoustic_residual.h"

namespace howl {

struct GainEquality {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    using std::log;
    const T squared = SquaredMagnitude(AcousticResponse(acoustics, T(frequency_hz)));
    return T(0.5 / std_relative) * log(squared / T(gain * gain));
  }

  double frequency_hz;
  double gain;
  double std_relative;
};

using GainEqualityResidual = AcousticResidual<GainEquality>;

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_GAIN_EQUALITY_H_
