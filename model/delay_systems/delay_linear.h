// A delay system linearised about a state of rest: D(s) = s I - A_0 - sum_k A_k e^(-s tau_k), with
// A_0 and A_k the derivatives of f by x(t) and by x(t - tau_k), as central differences
// (hopf_point.h).
#ifndef HOWL_MODEL_DELAY_SYSTEMS_DELAY_LINEAR_H_
#define HOWL_MODEL_DELAY_SYSTEMS_DELAY_LINEAR_H_

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "model/delay_systems/delay_system.h"

namespace howl::internal {

struct Linearised {
  Eigen::MatrixXd present;               // A_0
  std::vector<Eigen::MatrixXd> delayed;  // A_k
};

Linearised Linearise(const DelaySystem& system, double parameter, const Eigen::VectorXd& rest);

// D(s).
Eigen::MatrixXcd CharacteristicMatrix(const Linearised& a, const std::vector<double>& delays,
                                      std::complex<double> s);

}  // namespace howl::internal

#endif  // HOWL_MODEL_DELAY_SYSTEMS_DELAY_LINEAR_H_
