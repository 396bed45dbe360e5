#include "model/simulation/past_wave.h"

#include "model/numerics/units.h"

namespace howl::internal {

PastWave::PastWave(const InitialWave& wave, std::span<const ModeParameters> modes)
    : s(wave.growth_rate, kRadPerSPerHz * wave.frequency_hz),
      heat_now(std::polar(wave.amplitude, wave.phase_rad)) {
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const ModeParameters& mode = modes[k];
    const std::complex<double> d =
        s * s + 2.0 * mode.omega_rad_s * mode.xi * s + mode.omega_rad_s * mode.omega_rad_s;
    const std::complex<double> integral = mode.coefficient * heat_now / d;
    mode_integral[k] = (mode.omega_rad_s * integral).real();
    mode_pressure[k] = (s * integral).real();
    pressure_now += s * integral;
    rate_now += s * s * integral;
  }
}

}  // namespace howl::internal
