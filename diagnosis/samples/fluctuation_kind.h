// Which kind of fluctuation the flame's gain has: a Gaussian process of first order, or jumps
// between two levels at random times. Both are fitted to
//
//   g_i = 1 + Re C_i = h(A_i) + x_i + noise        Gaussian x
//   g_i = h(A_i) (1 or 1 - drop) + noise           two levels
//   h(A) = b_0 + b_1 u + b_2 u^2,    u = A - mean A
//
// C is the residual of cut B over the flame's predicted fundamental, and A that fundamental's slow
// amplitude. Each experiment has an h of its own, because a gain that drops lets the cycle decay,
// and the flame's curve was fitted to both levels at once. The noise is combustion noise, which is
// independent of the cycle's phase, so that Im C tells its variance.
#ifndef HOWL_DIAGNOSIS_SAMPLES_FLUCTUATION_KIND_H_
#define HOWL_DIAGNOSIS_SAMPLES_FLUCTUATION_KIND_H_

#include <vector>

namespace howl {

struct GainSeries {
  std::vector<double> gain;       // g
  std::vector<double> amplitude;  // A, about 1
  std::vector<double> variance;   // of the noise
};

struct ColouredFluctuation {
  double cost = 0.0;  // - log-likelihood, with Akaike's penalty
  double std = 0.0;   // of x
  double step_correlation = 0.0;
};

struct SwitchingFluctuation {
  double cost = 0.0;
  double drop = 0.0;                // of the gain, relative
  double leave_low_per_step = 0.0;  // probability
};

ColouredFluctuation FitColoured(const std::vector<GainSeries>& experiments);
SwitchingFluctuation FitSwitching(const std::vector<GainSeries>& experiments);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLES_FLUCTUATION_KIND_H_
