// What weights w of a loop's bins tell of one mode: the slopes by its parameters of
//
//   Re sum of w (a s + b omega) o,   o = 1 / (s^2 + 2 xi omega s + omega^2),   s = j x
//
// follow from five sums, whichever a and b are.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SUMS_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SUMS_H_

#include <Eigen/Core>
#include <complex>

#include "estimation/record_fit/loop/loop_point.h"
#include "model/numerics/complex_products.h"

namespace howl {

// o at frequencies j x.
inline void SetResonance(const LoopMode& mode, const Eigen::VectorXcd& s, Eigen::VectorXcd* out) {
  out->resize(s.size());
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    const double x = s[i].imag();
    (*out)[i] = Reciprocal({mode.omega * mode.omega - x * x, 2.0 * mode.xi * mode.omega * x});
  }
}

struct ModeSums {
  double o = 0.0;
  double s_o = 0.0;
  double oo = 0.0;
  double s_oo = 0.0;
  double ss_oo = 0.0;

  void Add(std::complex<double> w, double x, std::complex<double> over) {
    const std::complex<double> once = Times(w, over);
    const std::complex<double> twice = Times(once, over);
    o += once.real();
    s_o -= x * once.imag();
    oo += twice.real();
    s_oo -= x * twice.imag();
    ss_oo -= x * x * twice.real();
  }

  double ByRate() const { return s_o; }
  double ByLevel(const LoopMode& mode) const { return mode.omega * o; }
  // By the logarithm of xi or omega, where a and b are `rate` and `level`.
  double ByLogDamping(const LoopMode& mode, double rate, double level) const {
    return -2.0 * mode.xi * mode.omega * (rate * ss_oo + level * mode.omega * s_oo);
  }
  double ByLogOmega(const LoopMode& mode, double rate, double level) const {
    return level * mode.omega * o -
           2.0 * mode.omega * mode.omega * (rate * s_oo + level * mode.omega * oo) +
           ByLogDamping(mode, rate, level);
  }
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SUMS_H_
