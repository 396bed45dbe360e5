// Floquet multipliers of a limit cycle: small deviations from it obey the linear periodic equation
//
//   dq(t) = Phi'(v(t)) dv(t),   dv(t) = dp'(t - tau),   dp = G dq
//
// Over one period T the modes' states and the past of p' map linearly to themselves (monodromy).
// The map is built on a uniform grid of n steps a period by the exact propagation of the modes
// with dq interpolated to order 8, and the delay too. One multiplier is 1 (a shift along the
// cycle): its error tells the accuracy of all, and n doubles until it is small enough. The cycle
// is stable when all others have modulus below one.
#ifndef HOWL_MODEL_CYCLES_FLOQUET_H_
#define HOWL_MODEL_CYCLES_FLOQUET_H_

#include <complex>
#include <vector>

#include "model/cycles/harmonic_balance.h"

namespace howl {

struct FloquetOptions {
  double tolerance = 1e-6;  // of the multiplier that must be one
  int min_steps = 64;       // a period
  int max_dimension = 700;  // of the map
};

struct FloquetMultipliers {
  std::vector<std::complex<double>> multipliers;  // largest modulus first, without the trivial one
  double trivial_error = 0.0;                     // |multiplier - 1| of that one
  int steps = 0;                                  // a period
  bool stable = false;

  double leading_modulus() const { return multipliers.empty() ? 0.0 : std::abs(multipliers[0]); }
  // Of the slowest deviation, in 1/s: below zero when the cycle attracts.
  double LeadingGrowthRate(double frequency_hz) const {
    return std::log(leading_modulus()) * frequency_hz;
  }
};

FloquetMultipliers CycleStability(const ClosedLoop& model, const LimitCycle& cycle,
                                  const FloquetOptions& options = {});

}  // namespace howl

#endif  // HOWL_MODEL_CYCLES_FLOQUET_H_
