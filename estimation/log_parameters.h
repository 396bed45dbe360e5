// How residual blocks take their parameters. Every parameter is a Ceres block of size one that
// holds the natural logarithm of a positive quantity in its natural unit:
//
//   log omega_hz, log xi, log N, log tau_s, and log M or log(M / N) for the second mode.
//
// Blocks come in that order: acoustics first, the second mode after N, the delay last.
#ifndef HOWL_ESTIMATION_LOG_PARAMETERS_H_
#define HOWL_ESTIMATION_LOG_PARAMETERS_H_

#include <cmath>

#include "model/loop/acoustics.h"

namespace howl {

// The kind of the fourth parameter block, and the ratio of the modes' frequencies.
struct SecondMode {
  double harmonic_ratio = kPaperHarmonicRatio;
  bool relative = false;  // log(M / N) instead of log M
};

template <typename T>
Acoustics<T> OneModeFromLogs(const T* log_omega_hz, const T* log_xi, const T* log_N) {
  using std::exp;
  return {exp(*log_omega_hz), exp(*log_xi), exp(*log_N), T(0.0), T(kPaperHarmonicRatio)};
}

template <typename T>
Acoustics<T> TwoModesFromLogs(const SecondMode& second_mode, const T* log_omega_hz, const T* log_xi,
                              const T* log_N, const T* log_second) {
  using std::exp;
  const T M = second_mode.relative ? exp(*log_N + *log_second) : exp(*log_second);
  return {exp(*log_omega_hz), exp(*log_xi), exp(*log_N), M, T(second_mode.harmonic_ratio)};
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_LOG_PARAMETERS_H_
