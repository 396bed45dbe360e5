// What weights w of a loop's bins tell of one mode: the slopes by its parameters of
//
//   Re sum of w (a s + b omega) o,   o = 1 / (s^2 + 2 xi omega s + omega^2),   s = j x
//
// follow from five sums, whichever a and b are.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SUMS_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SUMS_H_

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

struct ModeSums {
  double o = 0.0;
  double s_o = 0.0;
  double oo = 0.0;
  double s_oo = 0.0;
  double ss_oo = 0.0;

  friend ModeSums operator+(const ModeSums& a, const ModeSums& b) {
    return {a.o + b.o, a.s_o + b.s_o, a.oo + b.oo, a.s_oo + b.s_oo, a.ss_oo + b.ss_oo};
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
