// Transforms of real signals, with half spectra as fft.h has them, by 1 / sqrt(N) either way: the
// squares of a signal and of its whole spectrum have one sum.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_UNITARY_TRANSFORM_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_UNITARY_TRANSFORM_H_

#include <Eigen/Core>

namespace howl {

// signal.size() / 2 + 1 values.
Eigen::VectorXcd UnitarySpectrum(const Eigen::VectorXd& signal);
Eigen::VectorXd UnitarySignal(Eigen::VectorXcd spectrum, Eigen::Index samples);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_UNITARY_TRANSFORM_H_
