// The flame's static characteristic q = Phi[pdot(t - tau)] (the paper, section 3.2), with the
// delayed derivative of the fundamental in place of the full one (4), f in hertz:
//
//   x(t) = 2 pi f p(t - tau + 1 / (4 f))                       (units of p per second)
//
// p here is its fundamental, joined from its blocks; or its fundamental and the harmonics locked to
// it (flame_regressor.h), whichever leaves q less scattered about the curve. The paper's (4) is the
// first: its q lacks the harmonics.
//
// Phi is estimated by means of q in bins of x, the paper's method, and as a polynomial over |x| <=
// 0.9 X, X = 2 pi f |p|, whose derivative at zero is Phi'(0) (flame_polynomial.h). It is that of a
// flame as smooth as the polynomial: one that bends sharply near the origin is steeper there than
// any record shows. To first order, noise left in x, of variance s^2 (Tweedie's formula for an x of
// arcsine density, and smoothing of Phi), and pressure other than x, of variance s_r^2
// (flame_dither.h), change the slope at zero to
//
//   (1 + s^2 / X^2) Phi'(0) + ((s^2 + s_r^2) / 2) Phi'''(0)
//
// which is corrected for; half of the correction enters the standard deviation. s^2 is the variance
// that the noise floor of p at the line, as far as it is incoherent with q, leaves in x.
//
// The mean cycle of q, q = mean - |q1| Re sum_k r_k e^(j k theta) with r_1 = 1, theta the phase of
// x, is the same curve in time: r_k is real for a flame without memory, and where x is its
// fundamental alone
//
//   Phi'(0) over D(X) = 1 - 3 r_3 + 5 r_5 - ...,      d ln D / d ln X = 6 r_3 + 10 r_5 + ...
//
// D: the describing function, |q1| / X, at which the loop gain is one. A flame that saturates has
// r_3 < 0.
#ifndef HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_CURVE_H_
#define HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_CURVE_H_

#include <complex>
#include <vector>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/analysis/spectra/record.h"
#include "estimation/analysis/spectra/spectrum.h"
#include "estimation/analysis/spectra/statistics.h"

namespace howl {

struct FlameCurveBin {
  double x = 0.0;      // mean of x in the bin
  double q = 0.0;      // mean of q
  double q_std = 0.0;  // of that mean; one independent value a passage through the bin
  int samples = 0;
};

struct FlameCurve {
  std::vector<FlameCurveBin> bins;
  double x_amplitude = 0.0;     // X
  Estimate slope;               // Phi'(0), in units of q per (unit of p per second)
  Estimate offset;              // Phi(0), in the record's q, mean included
  double saturation_low = 0.0;  // mean of q over x > 0.9 X and over x < -0.9 X, whichever is lower
  double saturation_high = 0.0;
  double hysteresis = 0.0;  // signed area of the mean cycle in (x, q) over pi X |q|: 1 for a circle
  int harmonics = 0;        // of p in x beyond the fundamental
  int degree = 0;           // of the polynomial
  std::vector<std::complex<double>> mean_cycle;  // r_1 .. r_5
  double regressor_noise = 0.0;                  // s^2 / X^2
  double dither = 0.0;                           // s_r^2 / X^2
  double relative_correction = 0.0;              // slope given over slope as fitted, less one
};

inline constexpr int kMeanCycleHarmonics = 5;

struct FlameCurveOptions {
  int bins = 40;
  double fit_range = 0.9;  // of X
  // 1: (4) as published. The k-th harmonic of p counts k^2-fold in the slope at zero, so that with
  // a flame that saturates hard harmonics up to the ninth matter.
  int max_harmonic = 9;
};

// The record has both channels, `spectrum` is its WelchSpectrum and `cycle` its limit cycle.
FlameCurve EstimateFlameCurve(const Record& record, const CrossSpectrum& spectrum,
                              const Characteristics& cycle, double tau_s,
                              const FlameCurveOptions& options = {});

// |L Phi'(0)| at the limit cycle with |G| = gain (1b): gain 2 pi f |Phi'(0)|. The errors of gain,
// frequency and slope count as independent.
Estimate LoopGainFromSlope(const Estimate& gain, const Estimate& frequency_hz,
                           const Estimate& flame_slope);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_CURVE_H_
