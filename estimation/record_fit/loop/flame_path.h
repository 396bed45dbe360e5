// How the flame's answer arrives: the transform of the density with which its delays are spread,
// mean tau and standard deviation rho tau,
//
//   none     e^(-tau s)
//   normal   e^((1 - sqrt(1 + 2 rho^2 tau s)) / rho^2)
//   gamma    (1 + rho^2 tau s)^(-1 / rho^2),   which is e^(-tau s) at rho = 0 and a lag at rho = 1
//
// times, where a share of the flame answers on a second path, later by lambda,
//
//   1 - share + share e^(-lambda s)
//
// No flame answers before it is driven: a normal density's lower tail would, and a likelihood that
// rests on residuals that follow from the past (return_difference.h) rewards that with thousands of
// nats where the spread is wide. So `normal` is the inverse Gaussian density (Folks & Chhikara
// 1978), the times that what a mean flow carries and turbulence diffuses takes to arrive: normal as
// rho falls, and of no delay below zero.
//
// A turbulent flame answers over the times that vortices take along it: a single delay makes its
// answer at high frequencies too strong. Where rho is not below one most of a gamma's answer comes
// at once, which no flame's does. A swirled flame answers twice, to the flow that reaches it as
// sound and to the swirl that is carried there (Palies et al. 2010): the second share may be
// negative, or larger than one.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_FLAME_PATH_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_FLAME_PATH_H_

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "model/numerics/complex_products.h"

namespace howl {

enum class DelaySpread : std::uint8_t { kNone, kNormal, kGamma };

// Those of a path are, in this order: ln tau; where delays are spread ln rho; of a second path its
// share and ln lambda.
inline constexpr std::size_t kMostPathParameters = 4;
using PathDerivatives = std::array<std::complex<double>, kMostPathParameters>;

// A path's answer at one frequency, and the slopes of its logarithm.
struct PathSlopes {
  std::complex<double> at;
  PathDerivatives by = {};
};

// What a path's answer at s takes from another frequency's when s moves on: those of s1 + s2 are
// the products of those of s1 and of s2.
struct PathTurns {
  std::complex<double> of_first = 1.0;   // e^(-tau s), where delays are not spread
  std::complex<double> of_second = 1.0;  // e^(-lambda s), where there is a second path

  PathTurns operator*(const PathTurns& other) const {
    return {Times(of_first, other.of_first), Times(of_second, other.of_second)};
  }
};

// How it falls beyond that frequency, and the slopes of this.
struct PathFall {
  std::complex<double> at;
  PathDerivatives by = {};
};

struct SecondPath {
  double share = 0.0;
  double lambda = 0.0;
};

struct FlamePath {
  DelaySpread spread = DelaySpread::kNone;
  double tau = 0.0;
  double rho = 0.0;  // where there is a spread: above 0
  std::optional<SecondPath> second = std::nullopt;

  std::complex<double> At(std::complex<double> s) const;
  Eigen::VectorXcd At(const Eigen::VectorXcd& s) const;
  // All in one, at little more than the cost of the first.
  PathSlopes WithSlopes(std::complex<double> s) const { return WithSlopes(s, TurnsAt(s)); }
  // Of one delay, which most paths are, without a call for each bin.
  PathSlopes WithSlopes(std::complex<double> s, const PathTurns& turns) const {
    if (spread == DelaySpread::kNone && !second) return {turns.of_first, {-tau * s}};
    return OfManyDelays(s, turns);
  }
  PathTurns TurnsAt(std::complex<double> s) const;
  // At(s) over its integral from s on, and its slopes. Of one path:
  //   none   tau     normal   tau / (sqrt(1 + 2 rho^2 tau s) + rho^2)
  //   gamma  tau (1 - rho^2) / (1 + rho^2 tau s)
  // Of two, the first falling by l: (1 - share + share e^(-lambda s)) over
  // (1 - share) / l + share e^(-lambda s) / (l + lambda), where l is taken as constant.
  PathFall Fall(std::complex<double> s) const;

 private:
  struct First {
    std::complex<double> fall, by_log_tau, by_log_rho;
  };

  PathSlopes OfManyDelays(std::complex<double> s, const PathTurns& turns) const;
  PathSlopes FirstWithSlopes(std::complex<double> s, std::complex<double> turn) const;
  First FirstFall(std::complex<double> s) const;
  // The index of the second path's share.
  std::size_t Second() const { return spread == DelaySpread::kNone ? 1 : 2; }
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_FLAME_PATH_H_
