// What a flame's curve may be before any record is seen: a smooth one (Rasmussen & Williams 2006,
// sections 2.7 and 4.2.1).
//
//   f(v) = a v + g(v),   a normal about zero,   g a Gaussian process:
//   cov g(v), g(w) = s^2 (1 + x + x^2 / 3) e^(-x),   x = sqrt(5) |v - w| / l       Matern, 5 / 2
//
// of the splines' coefficients b (flame_basis.h), which are the curve's values at the knots within
// a few per cent. Rewritten as b = W c, with one column of W a function, such that over a record
// the functions' spectra are orthogonal, each with the mean square one, and c are independent
// before any record is seen. Where all curves were alike, wild ones too, a curve would cost
// nothing: whatever damps its harmonics, as spread delays do, would be believed for it.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_FLAME_FUNCTIONS_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_FLAME_FUNCTIONS_H_

#include <Eigen/Core>

#include "estimation/record_fit/spectra/flame_basis.h"

namespace howl {

// The standard deviation of a, s, and l, in root mean squares of q and of v. A flame that answers
// to all of v and makes all of q has |a| = 1, or is the steeper the more it saturates; beside its
// line a curve holds no more than q does, and what is narrower than v's own size hardly shows in q.
// Of these and half and twice as much, measured records choose none (bench/flame_prior_study); of a
// right loop's records the narrower make more believe in spread delays.
struct FlamePrior {
  double slope = 3.0;
  double size = 1.0;
  double length = 1.0;
};

struct FlameFunctions {
  Eigen::MatrixXd of_splines;  // W: kFlameTerms x functions
  Eigen::VectorXd deviation;   // of each coefficient, in root mean squares of q; descending
};

// `spectra`: of the splines of v, one column each. `input`: v's root mean square.
FlameFunctions SmoothFlames(const FlamePrior& prior, const FlameBasis& basis,
                            const Eigen::MatrixXcd& spectra, double input);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_FLAME_FUNCTIONS_H_
