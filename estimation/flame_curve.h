// The flame's static characteristic q = Phi[pdot(t - tau)] (seed, section 3.2), with the delayed
// derivative of the fundamental in place of the full one (4), f in hertz:
//
//   x(t) = 2 pi f p(t - tau + 1 / (4 f))                       (units of p per second)
//
// p here is its fundamental alone, joined from its blocks (spectrum.h): (4) is right for nothing
// else, and harmonics, other lines and noise of p would be errors in the regressor.
//
// Phi is seen as means of q in bins of x, the seed's method, and as a polynomial of degree 5 over
// |x| <= 0.9 X, X = 2 pi f |p|, whose derivative at zero is Phi'(0). The error comes from the
// long-run variance of its influence function over blocks. It is that of a flame as smooth as the
// polynomial: one that bends sharply near the origin is steeper there than any record shows. Noise
// left in x, of variance s^2, changes the slope at zero to first order (Tweedie's formula for an x
// of arcsine density, and smoothing of Phi) to
//
//   (1 + s^2 / X^2) Phi'(0) + (s^2 / 2) Phi'''(0)
//
// which is taken out; half of the correction enters the standard deviation.
#ifndef HOWL_ESTIMATION_FLAME_CURVE_H_
#define HOWL_ESTIMATION_FLAME_CURVE_H_

#include <vector>

#include "estimation/characteristics.h"
#include "estimation/record.h"
#include "estimation/statistics.h"

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
  double regressor_noise = 0.0;      // s^2 / X^2
  double relative_correction = 0.0;  // slope given over slope as fitted, less one
};

struct FlameCurveOptions {
  int bins = 40;
  double fit_range = 0.9;  // of X
};

// The record has both channels, and `cycle` is its limit cycle.
FlameCurve EstimateFlameCurve(const Record& record, const Characteristics& cycle, double tau_s,
                              const FlameCurveOptions& options = {});

// |L Phi'(0)| at the limit cycle with |G| = gain (1b): gain 2 pi f |Phi'(0)|. Independent errors.
Estimate LoopGainFromSlope(const Estimate& gain, const Estimate& frequency_hz,
                           const Estimate& flame_slope);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FLAME_CURVE_H_
