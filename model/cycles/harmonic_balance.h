// Limit cycles of the loop by harmonic balance: p, q and v = p'(t - tau) as Fourier series
//
//   x(t) = Re sum_(k=0..H) X_k e^(j k 2 pi f t),    V_k = L(j k 2 pi f) Q_k,    q(t) = Phi(v(t))
//
// Unknowns are V_1 .. V_H and f, with Im V_1 = 0 to fix the phase; Newton with the exact Jacobian.
// The acoustics and the delay enter exactly, the flame in time (alternating frequency and time).
// H doubles until the last quarter of the harmonics is below the tolerance. One harmonic is the
// describing function of the paper's reference (Gelb & Van der Velde 1968).
//
// V_0 = 0 because L(0) = 0: a constant heat release does not reach the pressure.
#ifndef HOWL_MODEL_CYCLES_HARMONIC_BALANCE_H_
#define HOWL_MODEL_CYCLES_HARMONIC_BALANCE_H_

#include <complex>
#include <optional>
#include <vector>

#include "model/loop/laplace.h"

namespace howl {

struct HarmonicBalanceOptions {
  double tolerance = 1e-10;  // of the last harmonics, relative to the first, and of Newton's step
  int min_harmonics = 8;
  int max_harmonics = 256;
  int max_iterations = 40;
};

struct LimitCycle {
  double frequency_hz = 0.0;
  std::vector<std::complex<double>> rate;          // V_k, k = 0 .. H: p'(t - tau)
  std::vector<std::complex<double>> heat_release;  // Q_k: the units of q
  std::vector<std::complex<double>> pressure;      // P_k = G(j k 2 pi f) Q_k
  double tail = 0.0;  // largest of the last quarter of V, relative to V_1

  int harmonics() const { return static_cast<int>(rate.size()) - 1; }
  double rate_amplitude() const { return std::abs(rate[1]); }
  double pressure_amplitude() const { return std::abs(pressure[1]); }
  double heat_release_amplitude() const { return std::abs(heat_release[1]); }
};

// The cycle that Newton reaches from a frequency and an amplitude of v (units of p / s); nothing
// if Newton fails, falls to rest, or the harmonics do not decay within the limit.
std::optional<LimitCycle> SolveLimitCycle(const ClosedLoop& model, double frequency_guess_hz,
                                          double rate_amplitude_guess,
                                          const HarmonicBalanceOptions& options = {});

// From a neighbouring cycle, for instance of slightly different parameters.
std::optional<LimitCycle> RefineLimitCycle(const ClosedLoop& model, const LimitCycle& start,
                                           const HarmonicBalanceOptions& options = {});

// One start for each phase crossing and each amplitude at which the describing function closes the
// loop there: with a flame that is steeper away from rest, also cycles of a loop that is stable at
// rest. Duplicates are removed; in order of frequency. What no describing function
// sees is not found: follow a branch to it (model/cycles/continuation.h).
std::vector<LimitCycle> LimitCycles(const ClosedLoop& model, double frequency_max_hz,
                                    const HarmonicBalanceOptions& options = {});

// The value of a Fourier series at phase theta = 2 pi f t.
double EvaluateHarmonics(const std::vector<std::complex<double>>& series, double theta);

}  // namespace howl

#endif  // HOWL_MODEL_CYCLES_HARMONIC_BALANCE_H_
