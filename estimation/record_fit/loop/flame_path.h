// How the flame's answer arrives: the transform of the density with which its delays are spread,
// mean tau and standard deviation rho tau,
//
//   none     e^(-tau s)
//   normal   e^((1 - sqrt(1 + 2 rho^2 tau s)) / rho^2)
//   gamma    (1 + rho^2 tau s)^(-1 / rho^2),   which is e^(-tau s) at rho = 0 and a lag at rho = 1
//
// No flame answers before it is driven: a normal density's lower tail would, and a likelihood that
// rests on residuals that follow from the past (return_difference.h) rewards that with thousands of
// nats where the spread is wide. So `normal` is the inverse Gaussian density (Folks & Chhikara
// 1978), the times that what a mean flow carries and turbulence diffuses takes to arrive: normal as
// rho falls, and of no delay below zero.
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
  // At(s) over its integral from s on, and that by ln tau and by ln rho:
  //   none   tau     normal   tau / (sqrt(1 + 2 rho^2 tau s) + rho^2)
  //   gamma  tau (1 - rho^2) / (1 + rho^2 tau s)
  std::complex<double> Fall(std::complex<double> s) const;
  std::complex<double> FallByLogTau(std::complex<double> s) const;
  std::complex<double> FallByLogRho(std::complex<double> s) const;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_FLAME_PATH_H_
