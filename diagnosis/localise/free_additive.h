// Signals that are added to the loop and not caused by it: in each band an independent signal of
// free power s at one place, which appears in (E_A, E_B) with the direction u,
//
//   in the duct, not the flame      u = (1, 0)    the flame responds to it as always
//   in recorded p                   u = (1, -F)   F: q from p through delay and flame
//   in recorded q                   u = (-R, 1)
//
// against the base's noise: covariance diag(a V_A, V_B) + s u u^H, s and a <= 1 free in each band,
// since V_A may already hold part of it. Two numbers a band.
#ifndef HOWL_DIAGNOSIS_LOCALISE_FREE_ADDITIVE_H_
#define HOWL_DIAGNOSIS_LOCALISE_FREE_ADDITIVE_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct AdditiveGain {  // of log-likelihood over the base
  double source = 0.0;
  double pressure = 0.0;
  double heat_release = 0.0;
  double parameters = 0.0;  // of each
  double low_hz = 0.0;      // bands that bring a tenth of the best one's or more
  double high_hz = 0.0;
};

AdditiveGain FitFreeAdditive(const std::vector<CutRecord>& records, const EffectFit& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_FREE_ADDITIVE_H_
