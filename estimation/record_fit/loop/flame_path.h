// How the flame's answer arrives: the transform of the density with which its delays are spread,
// mean tau and standard deviation rho tau,
//
//   none     e^(-tau s)
//   normal   e^(-tau s + (rho tau s)^2 / 2)
//   gamma    (1 + rho^2 tau s)^(-1 / rho^2),   which is e^(-tau s) at rho = 0 and a lag at rho = 1
//
// A turbulent flame answers over the times that vortices take along it: a single delay makes its
// answer at high frequencies too strong. Where rho is not below one most of a gamma's answer comes
// at once, which no flame's does.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_FLAME_PATH_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_FLAME_PATH_H_

#include <Eigen/Core>
#include <complex>
#include <cstdint>

namespace howl {

enum class DelaySpread : std::uint8_t { kNone, kNormal, kGamma };

// A path's answer at one frequency, with d ln At by ln tau and by ln rho.
struct PathSlopes {
  std::complex<double> at;
  std::complex<double> by_log_tau;
  std::complex<double> by_log_rho;
};

struct FlamePath {
  DelaySpread spread = DelaySpread::kNone;
  double tau = 0.0;
  double rho = 0.0;  // where there is a spread: above 0

  std::complex<double> At(std::complex<double> s) const;
  Eigen::VectorXcd At(const Eigen::VectorXcd& s) const;
  // All three in one, at little more than the cost of the first.
  PathSlopes WithSlopes(std::complex<double> s) const;
  // d ln At by ln tau and by ln rho.
  std::complex<double> ByLogTau(std::complex<double> s) const;
  std::complex<double> ByLogRho(std::complex<double> s) const;
  // d ln At / ds, and that by ln tau and by ln rho.
  std::complex<double> BySlope(std::complex<double> s) const;
  std::complex<double> BySlopeAndLogTau(std::complex<double> s) const;
  std::complex<double> BySlopeAndLogRho(std::complex<double> s) const;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_FLAME_PATH_H_
