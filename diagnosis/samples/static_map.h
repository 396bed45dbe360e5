// A recorded signal that saturates (cut A): on its plateaus the record falls short of the true
// signal by a bump, taken as c + d x_1(t) + e x_1(t)^2 there, x_1 being the signal's part near the
// cycle,
//
//   q clipped:  E_A = P - R (Q + sum c H)      p clipped:  E_A = P + sum c H - R Q
//
// H: spectra of these bumps, upper and lower plateau apart. Combustion noise and the flame's own
// saturation are the same in p and q, and do not count.
#ifndef HOWL_DIAGNOSIS_SAMPLES_STATIC_MAP_H_
#define HOWL_DIAGNOSIS_SAMPLES_STATIC_MAP_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "model/loop/instrument.h"

namespace howl {

inline constexpr int kClippingShapes = 6;  // of the bumps: 1, x_1 and x_1^2 on either plateau

struct ClippingFit {
  EffectFit fit;          // base parameters, and residuals with the excess given back
  double gain = 0.0;      // log-likelihood over the base; 0 if the signal would have to shrink
  double fraction = 0.0;  // plateau over the amplitude with the bumps given back
  // Variance of cut B's residual while q is on its plateaus, over that elsewhere: combustion noise
  // is as large there, unless the record is cut off.
  double plateau_noise = 1.0;
  bool sharp_edge = false;  // the amplitude density ends in an edge, which needs no model
};

ClippingFit FitClipping(const std::vector<CutRecord>& records, Channel channel,
                        const EffectFit& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLES_STATIC_MAP_H_
