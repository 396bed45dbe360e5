// FFT of real signals, half spectrum: X_k = sum x_n e^(-2 pi j k n / N), k = 0 ... N/2.
#ifndef HOWL_DIAGNOSIS_NUMERICS_REAL_FFT_H_
#define HOWL_DIAGNOSIS_NUMERICS_REAL_FFT_H_

#include <Eigen/Core>

namespace howl {

Eigen::VectorXcd ForwardFft(const Eigen::VectorXd& signal);

// The real signal of `size` samples whose half spectrum this is.
Eigen::VectorXd InverseFft(const Eigen::VectorXcd& half_spectrum, Eigen::Index size);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NUMERICS_REAL_FFT_H_
