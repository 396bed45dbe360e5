// The one-mode model in closed form. With t = tan(-Delta), Delta the phase from q to p at the
// limit-cycle frequency f, equations (5c) and (3) solve to
//
//   omega = f (sqrt(xi^2 t^2 + 1) - xi t) = f e^(-asinh(xi t))
//   N     = gain * 2 xi (2 pi omega) / cos(Delta)
//   tau   = (270 degrees + Delta) / (360 degrees f)
//
// So each experiment alone leaves exactly one direction free; xi runs along it. Needs
// |Delta| < 90 degrees. omega and f in hertz, tau in seconds, N in (units of gain) * rad/s.
#ifndef HOWL_ESTIMATION_CLOSED_FORM_H_
#define HOWL_ESTIMATION_CLOSED_FORM_H_

#include <cmath>

#include "estimation/experiment.h"
#include "estimation/parameters.h"
#include "model/units.h"

namespace howl {

inline double ClosedFormOmegaHz(double frequency_hz, double phase_deg, double xi) {
  return frequency_hz * std::exp(-std::asinh(xi * std::tan(-phase_deg * kRadPerDeg)));
}

// tau of equation (3); `turns` adds whole periods (zero in the seed).
inline double DelayFromPhase(double frequency_hz, double phase_deg, int turns = 0) {
  return (270.0 + phase_deg + 360.0 * turns) / (360.0 * frequency_hz);
}

inline LoopModel ClosedFormModel(const Experiment& experiment, double xi) {
  const double omega_hz = ClosedFormOmegaHz(experiment.frequency_hz, experiment.phase_deg, xi);
  const double N = experiment.gain * 2.0 * xi * kRadPerSPerHz * omega_hz /
                   std::cos(experiment.phase_deg * kRadPerDeg);
  return {.omega_hz = omega_hz,
          .xi = xi,
          .N = N,
          .tau_s = DelayFromPhase(experiment.frequency_hz, experiment.phase_deg)};
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_CLOSED_FORM_H_
