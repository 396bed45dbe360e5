// One experiment's member in closed form, for the one-mode model (M = 0; the paper, (5c) and (1a)).
//
// With f the limit-cycle frequency, theta the phase of G there and t = tan(-theta),
//
//   omega = f (sqrt(xi^2 t^2 + 1) - xi t) = f exp(-asinh(xi t))
//   N     = |z| 2 xi (2 pi omega) / cos(theta)
//   2 pi f tau = 3 pi / 2 + theta - loop phase error + 2 pi delay_periods                      (3)
//
// so that each experiment's members are exactly a box in (xi, theta, |z|, loop phase error): xi is
// free, the three others within the test's tolerances. p lags q when theta < 0, and then
// omega < f. theta must lie within (-90, 90) degrees, xi > 0.
#ifndef HOWL_ESTIMATION_ANALYSIS_LOOP_CLOSED_FORM_H_
#define HOWL_ESTIMATION_ANALYSIS_LOOP_CLOSED_FORM_H_

#include <cmath>
#include <numbers>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "model/numerics/units.h"

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

// The frequency of the mode that alone gives G the phase theta at f: the largest omega that two
// modes can have.
inline double OneModeOmega(double frequency_hz, double xi, double phase_rad) {
  return OmegaFromDetuning(frequency_hz, xi * std::tan(-phase_rad));
}

// Its coefficient for the gain |z| at f.
inline double OneModeN(double omega_hz, double xi, double phase_rad, double gain) {
  return gain * 2.0 * xi * kRadPerSPerHz * omega_hz / std::cos(phase_rad);
}

// Equation (3), here alone: w tau + loop phase error = LoopTurns(theta, delay_periods). T: double,
// or a Jet.
template <typename T>
T LoopTurns(const T& phase_rad, int delay_periods) {
  return 1.5 * std::numbers::pi + phase_rad + 2.0 * std::numbers::pi * delay_periods;
}

inline double TauFromPhase(double frequency_hz, double phase_rad, double loop_phase_error_rad,
                           int delay_periods) {
  return (LoopTurns(phase_rad, delay_periods) - loop_phase_error_rad) /
         (kRadPerSPerHz * frequency_hz);
}

// The paper's (3), from a phase in degrees.
inline double DelayFromPhase(double frequency_hz, double phase_deg, int delay_periods = 0) {
  return TauFromPhase(frequency_hz, phase_deg * kRadPerDeg, 0.0, delay_periods);
}

inline double DelayOf(const Experiment& experiment) {
  return DelayFromPhase(experiment.frequency_hz, experiment.phase_deg, experiment.delay_periods);
}

inline LoopModel ClosedFormMember(const Experiment& experiment, double xi,
                                  const FitErrors& errors = {}) {
  const double phase_rad = (experiment.phase_deg + errors.phase_error_deg) * kRadPerDeg;
  const double gain = experiment.gain * (1.0 + errors.gain_error);
  LoopModel model;
  model.xi = xi;
  model.omega_hz = OneModeOmega(experiment.frequency_hz, xi, phase_rad);
  model.N = OneModeN(model.omega_hz, xi, phase_rad, gain);
  model.M = 0.0;
  model.tau_s = TauFromPhase(experiment.frequency_hz, phase_rad,
                             errors.loop_phase_error_deg * kRadPerDeg, experiment.delay_periods);
  return model;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_LOOP_CLOSED_FORM_H_
