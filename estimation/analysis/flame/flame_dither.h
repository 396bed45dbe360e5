// The flame's input that the regressor of flame_regressor.h leaves out: the pressure of the band
// between the lines, which is coherent with q. For x = xhat + r with r independent of xhat, of
// variance s_r^2 (a Berkson error: nothing is attenuated, but the curve is smoothed),
//
//   E[q | xhat] = E Phi(xhat + r),    slope at zero = Phi'(0) + (s_r^2 / 2) Phi'''(0) + ...
//
//   s_r^2 = integral (2 pi f)^2 c(f) S_pp(f) (1 - H(f - f0)^2)^2 df
//
// over all but the cycle's harmonics. c: coherence of p and q, which leaves noise of the p sensor
// out; H: the response of a Hann block, which the regressor applies twice, to cut and to join.
#ifndef HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_DITHER_H_
#define HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_DITHER_H_

#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

// s_r^2 in (units of p per second)^2, for blocks of block_s seconds at frequency_hz; frequencies up
// to top_hz count.
double DitherVariance(const CrossSpectrum& spectrum, double frequency_hz, double block_s,
                      double top_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_DITHER_H_
