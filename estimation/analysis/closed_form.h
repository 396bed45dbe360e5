// One experiment's member in closed form, for the one-mode model (M = 0; the paper, (5c) and (1a)).
//
// With f the limit-cycle frequency, theta the phase of G there and t = tan(-theta),
//
//   omega = f (sqrt(xi^2 t^2 + 1) - xi t) = f exp(-asinh(xi t))
//   N     = |z| 2 xi (2 pi omega) / cos(theta)
//   2 pi f tau = 3 pi / 2 + theta - loop phase error
//
// so that each experiment's members are exactly a box in (xi, theta, |z|, loop phase error): xi is
// free, the three others within the test's tolerances. p lags q when theta < 0, and then
// omega < f. theta must lie within (-90, 90) degrees, xi > 0.
#ifndef HOWL_ESTIMATION_ANALYSIS_CLOSED_FORM_H_
#define HOWL_ESTIMATION_ANALYSIS_CLOSED_FORM_H_

#include <cmath>
#include <numbers>

#include "estimation/analysis/experiment.h"
#include "estimation/parameters.h"
#include "model/units.h"

namespace howl {

// What the test measures on one experiment; all zero is a perfect fit. Signs as in
// ExperimentErrors.
struct FitErrors {
  double gain_error = 0.0;
  double phase_error_deg = 0.0;
  double loop_phase_error_deg = 0.0;
};

// sinh(ln(f / omega)): zero at resonance, positive where the mode lies below f. Along a one-mode
// family it equals xi tan(-theta).
inline double Detuning(double frequency_hz, double omega_hz) {
  return 0.5 * (frequency_hz / omega_hz - omega_hz / frequency_hz);
}

inline double OmegaFromDetuning(double frequency_hz, double detuning) {
  const double root = std::sqrt(1.0 + detuning * detuning);
  // f exp(-asinh(d)) without cancellation on either side.
  return detuning > 0.0 ? frequency_hz / (root + detuning) : frequency_hz * (root - detuning);
}

inline double TauFromPhase(double frequency_hz, double phase_rad, double loop_phase_error_rad,
                           int delay_periods = 0) {
  return (1.5 * std::numbers::pi + phase_rad - loop_phase_error_rad +
          2.0 * std::numbers::pi * delay_periods) /
         (kRadPerSPerHz * frequency_hz);
}

// The paper's (3), from a phase in degrees.
inline double DelayFromPhase(double frequency_hz, double phase_deg, int delay_periods = 0) {
  return TauFromPhase(frequency_hz, phase_deg * kRadPerDeg, 0.0, delay_periods);
}

inline LoopModel ClosedFormMember(const Experiment& experiment, double xi,
                                  const FitErrors& errors = {}) {
  const double phase_rad = (experiment.phase_deg + errors.phase_error_deg) * kRadPerDeg;
  const double gain = experiment.gain * (1.0 + errors.gain_error);
  LoopModel model;
  model.xi = xi;
  model.omega_hz = OmegaFromDetuning(experiment.frequency_hz, xi * std::tan(-phase_rad));
  model.N = gain * 2.0 * xi * kRadPerSPerHz * model.omega_hz / std::cos(phase_rad);
  model.M = 0.0;
  model.tau_s =
      TauFromPhase(experiment.frequency_hz, phase_rad, errors.loop_phase_error_deg * kRadPerDeg);
  return model;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_CLOSED_FORM_H_
