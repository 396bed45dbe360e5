// How the cycle's harmonics follow what drives the flame's curve. About a multiple h of the cycle's
// frequency the curve makes Q_h of its input v, and of (1 + g) v, g being small and slow,
//
//   (1 + k_h g) Q_h,   k_h = d ln Q_h / d ln v
//
// A curve that saturates has k_1 below one, and others above it.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_CURVE_EXPONENTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_CURVE_EXPONENTS_H_

#include <Eigen/Core>

#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// Of the cycle's frequency: as far as its lines reach (loop_point.h).
inline constexpr double kBesideCycle = 0.06;

// |k_h| for each multiple that the band holds, of a flame with these coefficients.
Eigen::VectorXd CurveExponents(const RecordSpectra& record, const Eigen::VectorXd& flame);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_CURVE_EXPONENTS_H_
