// First derivatives of the loop's phase and gain (the paper, figures 13 and 14), from
//
//   d log L = d log|L| + j d arg L
//
// with respect to each parameter and to frequency. Phases in degrees, gains as natural logarithms;
// per natural unit of the parameter (Hz, 1, N's and M's unit, 1, s).
#ifndef HOWL_MODEL_LOOP_SENSITIVITY_H_
#define HOWL_MODEL_LOOP_SENSITIVITY_H_

#include <array>
#include <string_view>

#include "model/loop/loop.h"

namespace howl {

enum class LoopParameter { kOmega, kXi, kN, kM, kHarmonicRatio, kTau };
inline constexpr std::array<std::string_view, 6> kLoopParameterNames = {
    "omega_hz", "xi", "N", "M", "harmonic_ratio", "tau_s"};

struct Sensitivity {
  double phase_deg = 0.0;
  double log_gain = 0.0;
};

struct LoopSensitivity {
  std::array<Sensitivity, 6> parameter;  // by LoopParameter
  Sensitivity frequency;                 // per Hz

  const Sensitivity& operator[](LoopParameter p) const {
    return parameter[static_cast<std::size_t>(p)];
  }
  // How a crossing's frequency moves so that the phase stays: Hz per unit of the parameter.
  double CrossingShiftHz(LoopParameter p) const {
    return -(*this)[p].phase_deg / frequency.phase_deg;
  }
};

LoopSensitivity LoopSensitivityAt(const LoopParameters<double>& loop, double frequency_hz);

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_SENSITIVITY_H_
