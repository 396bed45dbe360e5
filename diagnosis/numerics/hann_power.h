// The power spectrum of a whole signal under Hann's window,
//
//   P_k = |sum_n w_n x_n e^(-2 pi j k n / N)|^2 / sum_n w_n^2,   w_n = 1 - cos(2 pi (n + 1/2) / N)
//
// k = 0 ... N/2: of white noise, its variance on average.
#ifndef HOWL_DIAGNOSIS_NUMERICS_HANN_POWER_H_
#define HOWL_DIAGNOSIS_NUMERICS_HANN_POWER_H_

#include <Eigen/Core>
#include <vector>

namespace howl {

Eigen::VectorXd HannPower(const std::vector<double>& signal);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NUMERICS_HANN_POWER_H_
