// arg G(j 2 pi f) = Delta at the limit-cycle frequency f: second line of (5a), or of (5c).
//
//   residual = arg(G e^(-j Delta)) / std
//
// Delta: measured phase from q to p, degrees; std_deg: its standard deviation. G is rotated back by
// Delta before its angle is taken, so that the residual is wrapped.
#ifndef HOWL_ESTIMATION_RESIDUALS_PHASE_EQUALITY_H_
#define HOWL_ESTIMATION_RESIDUALS_PHASE_EQUALITY_H_

#include "estimation/residuals/acoustic_residual.h"

namespace howl {

struct PhaseEquality {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    const Complex<double> back = UnitPhasor(-phase_deg * kRadPerDeg);
    return T(kDegPerRad / std_deg) *
           Angle(AcousticResponse(acoustics, T(frequency_hz)) * Complex<T>{T(back.re), T(back.im)});
  }

  double frequency_hz;
  double phase_deg;
  double std_deg;
};

using PhaseEqualityResidual = AcousticResidual<PhaseEquality>;

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_PHASE_EQUALITY_H_
