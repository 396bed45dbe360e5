// The operating parameter at which the limit cycle vanishes (the paper, section 3.2 and figure 7):
// a straight line g = a + b phi through the loop gains (straight_line.h) reaches one at
// phi = (1 - a) / b. Fieller's interval: all phi with
//
//   (a + b phi - 1)^2 <= t^2 var(a + b phi)
#ifndef HOWL_ESTIMATION_ANALYSIS_LOOP_VANISHING_PHI_H_
#define HOWL_ESTIMATION_ANALYSIS_LOOP_VANISHING_PHI_H_

#include <span>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/analysis/spectra/statistics.h"

namespace howl {

struct LoopGainPoint {
  double phi = 0.0;
  Estimate loop_gain;  // std NaN: unknown
};

struct VanishingPhi {
  double phi = std::numeric_limits<double>::quiet_NaN();
  double lo = -std::numeric_limits<double>::infinity();  // 95 %; infinite: the slope may be zero
  double hi = std::numeric_limits<double>::infinity();
  double intercept = 0.0, slope = 0.0;
  bool available = false;  // needs three points with at least two different phi
};

VanishingPhi EstimateVanishingPhi(std::span<const LoopGainPoint> points);

// From the loop gains gain 2 pi f |Phi'(0)| of the reliable experiments that have a flame slope
// (the paper, figure 7).
VanishingPhi EstimateVanishingPhi(std::span<const Experiment> experiments);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_LOOP_VANISHING_PHI_H_
