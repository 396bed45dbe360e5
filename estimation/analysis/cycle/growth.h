// Growth of an oscillation out of noise, from pressure alone. While a linear loop is unstable its
// envelope grows as A(t) = A_0 e^(sigma t); noise makes log A a trend plus a random walk plus white
// noise, whose slope FitTrend estimates with its interval (statistics.h). The window runs from
// where the envelope last leaves the noise (`above_noise` times its 95 % quantile before) to where
// saturation begins (`below_peak` of the highest envelope). Neither end is sharp, and the rate may
// change over the window; half of its change by the fitted curvature is taken for a uniform error.
#ifndef HOWL_ESTIMATION_ANALYSIS_CYCLE_GROWTH_H_
#define HOWL_ESTIMATION_ANALYSIS_CYCLE_GROWTH_H_

#include <span>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

struct GrowthOptions {
  double above_noise = 10.0;
  double below_peak = 0.5;
  double block_periods = 16.0;
};

struct Growth {
  bool available = false;  // false: the record holds no growth over a factor of three
  Estimate rate_per_s;
  Estimate frequency_hz;  // during the growth
  double start_s = 0.0, end_s = 0.0;
  double start_amplitude = 0.0, end_amplitude = 0.0;
};

// frequency_hz: near the oscillation's, within a tenth.
Growth EstimateGrowth(std::span<const double> p, double sampling_hz, double frequency_hz,
                      const GrowthOptions& options = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_CYCLE_GROWTH_H_
