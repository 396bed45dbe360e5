// A recorded signal that saturates (cut A): the record x falls short of the true signal where it is
// at its top or bottom, by about c (|x| - threshold) there,
//
//   q clipped:  E_A = P - R (Q + c+ H+ + c- H-)      p clipped:  E_A = P + c+ H+ + c- H- - R Q
//
// H: spectrum of the excess of x over a threshold just below its extremes. Combustion noise and the
// flame's own saturation are the same in p and q, and do not count.
#ifndef HOWL_DIAGNOSIS_STATIC_MAP_H_
#define HOWL_DIAGNOSIS_STATIC_MAP_H_

#include <vector>

#include "diagnosis/effect_fit.h"

namespace howl {

struct ClippingFit {
  EffectFit fit;            // base parameters, and residuals with the excess given back
  double gain = 0.0;        // log-likelihood over the base; 0 if the signal would have to shrink
  double fraction = 0.0;    // threshold over the amplitude with the excess given back
  bool sharp_edge = false;  // the amplitude density ends in an edge: seen without any model
};

ClippingFit FitClipping(const std::vector<CutRecord>& records, bool pressure,
                        const EffectFit& base);

struct FewLevels {
  bool found = false;
  double levels = 0.0;  // mean over the experiments
};

FewLevels FindQuantisation(const std::vector<CutRecord>& records);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_STATIC_MAP_H_
