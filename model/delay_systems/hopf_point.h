// Stability of a rest state of a delay system, and where it is lost to an oscillation (Hopf).
//
// With A_0 and A_k the derivatives of f at rest by x(t) and by x(t - tau_k), the roots of
//
//   det D(s) = 0,     D(s) = s I - A_0 - sum_k A_k e^(-s tau_k)
//
// decide. They are found as eigenvalues of the infinitesimal generator, discretised at Chebyshev
// points over the longest delay (D. Breda, S. Maset and R. Vermiglio, SIAM J. Sci. Comput. 27:482,
// 2005). At a Hopf point a pair lies on the imaginary axis: Newton's method on
//
//   D(j w; lambda) v = 0,     v_0^* v = 1
//
// in the complex v and the real w and lambda, to rounding; the derivatives of f are central
// differences.
#ifndef HOWL_MODEL_DELAY_SYSTEMS_HOPF_POINT_H_
#define HOWL_MODEL_DELAY_SYSTEMS_HOPF_POINT_H_

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "model/delay_systems/delay_system.h"

namespace howl {

struct HopfPoint {
  double parameter = 0.0;
  double omega = 0.0;  // rad per unit of time
  // d Re s / d lambda of the pair: positive where the oscillation grows with the parameter.
  double crossing_rate = 0.0;
};

// The state of rest that Newton's method reaches from `start`: f(lambda, x, x, ..., x) = 0.
std::optional<Eigen::VectorXd> FindRest(const DelaySystem& system, double parameter,
                                        const Eigen::VectorXd& start);

// Roots at the rest state, the rightmost first; `points` over the longest delay. Those whose
// oscillation the points do not resolve are not accurate.
std::vector<std::complex<double>> CharacteristicRoots(const DelaySystem& system, double parameter,
                                                      const Eigen::VectorXd& rest, int points = 16);

// The Hopf point between two parameters, at one of which the rightmost pair lies to the left of the
// axis and at the other to the right; none where it does not, or where a real root crosses.
std::optional<HopfPoint> FindHopf(const DelaySystem& system, double parameter_low,
                                  double parameter_high, const Eigen::VectorXd& rest_start);

}  // namespace howl

#endif  // HOWL_MODEL_DELAY_SYSTEMS_HOPF_POINT_H_
