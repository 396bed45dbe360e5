// Slow fluctuations of the flame's gain. The residual of cut B is demodulated by the flame's
// predicted fundamental:
//
//   D(t) = lowpass(e_B conj(a)) / sqrt(lowpass(|a|^2) mean(|a|^2)),   a: analytic signal of Phi(v)
//   near the cycle
//
// Combustion noise is independent of the cycle's phase and moves Re D and Im D alike. A fluctuating
// gain moves Re D alone. fluctuation_kind.h tells which kind of fluctuation it is.
#ifndef HOWL_DIAGNOSIS_SAMPLES_GAIN_FLUCTUATION_H_
#define HOWL_DIAGNOSIS_SAMPLES_GAIN_FLUCTUATION_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct GainFluctuation {
  double gain = 0.0;             // log-likelihood of unequal variances over equal ones
  double quadrature_gain = 0.0;  // the same where Im D is the larger one: a delay that wanders
  double in_phase_std = 0.0;     // of Re D
  double quadrature_std = 0.0;
  double correlation_s = 0.0;  // of Re D
  double coloured_cost = 0.0;  // - log-likelihood, with Akaike's penalty
  double switching_cost = 0.0;
  double low_level = 0.0;                   // of the two levels, relative to the upper one
  double dwell_s = 0.0;                     // mean time on the lower level
  std::vector<Eigen::VectorXcd> corrected;  // E_B of each experiment without the fluctuation
};

GainFluctuation EstimateGainFluctuation(const std::vector<CutRecord>& records,
                                        const EffectFit& fit);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLES_GAIN_FLUCTUATION_H_
