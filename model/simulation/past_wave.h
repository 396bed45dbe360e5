// One exponential of a rig's past, answered by the modes' transfer functions: q = amplitude
// exp(i phase) exp(s t), s = growth rate + i omega, and of each mode c s q / (s^2 + 2 omega_k xi_k
// s
// + omega_k^2).
#ifndef HOWL_MODEL_SIMULATION_PAST_WAVE_H_
#define HOWL_MODEL_SIMULATION_PAST_WAVE_H_

#include <array>
#include <complex>
#include <span>

#include "model/simulation/lane_group.h"

namespace howl::internal {

struct PastWave {
  PastWave(const InitialWave& wave, std::span<const ModeParameters> modes);

  // Adds p', q and p at time t_s, the present being 0.
  void AddAt(double t_s, double* rate, double* heat, double* pressure) const {
    const std::complex<double> turn = std::exp(s * t_s);
    *rate += (rate_now * turn).real();
    *heat += (heat_now * turn).real();
    *pressure += (pressure_now * turn).real();
  }

  std::complex<double> s;
  std::complex<double> heat_now;
  std::complex<double> rate_now = 0.0;
  std::complex<double> pressure_now = 0.0;
  // At present: omega_k times the integral of the mode's pressure, and its pressure.
  std::array<double, kMaxModes> mode_integral{};
  std::array<double, kMaxModes> mode_pressure{};
};

}  // namespace howl::internal

#endif  // HOWL_MODEL_SIMULATION_PAST_WAVE_H_
