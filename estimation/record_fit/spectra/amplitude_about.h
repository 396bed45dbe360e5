// How loud a signal is about a multiple of the cycle's frequency, over time:
//
//   A^2 = x^2 + y^2,   x: the signal as far as it lies about that frequency, y: x a quarter later
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_AMPLITUDE_ABOUT_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_AMPLITUDE_ABOUT_H_

#include <Eigen/Core>

#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// At the record's instants, of a signal's bins as edge_s has them. reach: over the cycle's
// frequency, to either side.
Eigen::VectorXd SquaredAmplitudeAbout(double multiple, double reach, const Eigen::VectorXcd& edges,
                                      const RecordSpectra& record);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_AMPLITUDE_ABOUT_H_
