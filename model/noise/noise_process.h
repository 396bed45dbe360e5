// A stationary Gaussian process of a stated spectrum, sampled exactly at a constant rate. One-sided
// power spectral densities, of mean square sigma^2:
//
//   white       S(f) = 2 sigma^2 / f_s                       up to half of the sampling rate f_s
//   low-pass    S(f) = S_0 / (1 + (f / f_c)^2),              S_0 = 2 sigma^2 / (pi f_c)
//   resonance   S(f) = S_0 / ((1 - u^2)^2 + (2 zeta u)^2),   S_0 = 4 zeta sigma^2 / (pi f_0),
//               u = f / f_0
//
// The last two are the answers of a first-order low-pass and of a damped oscillator to white noise
// (S. H. Crandall and W. D. Mark, Random Vibration in Mechanical Systems, 1963, ch. 2). The state
// goes from sample to sample by its matrix exponential E, with an innovation of the covariance
// P - E P E^T that keeps the stationary P; what lies beyond f_s / 2 folds back, as in samples of
// the continuous process it does.
#ifndef HOWL_MODEL_NOISE_NOISE_PROCESS_H_
#define HOWL_MODEL_NOISE_NOISE_PROCESS_H_

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "model/noise/random_stream.h"

namespace howl {

enum class NoiseColour : std::uint8_t { kWhite, kLowPass, kResonance };

struct NoiseSpectrum {
  NoiseColour colour = NoiseColour::kWhite;
  double frequency_hz = 0.0;  // f_c, or f_0
  double damping = 0.0;       // zeta, of the resonance: above 0, below 1

  // S(f) over sigma^2, in 1 / Hz; of samples at rate_hz where it is white.
  double DensityPerSquare(double f_hz, double rate_hz) const;
};

class NoiseProcess {
 public:
  NoiseProcess() = default;  // without noise
  // Starts in its stationary state.
  NoiseProcess(const NoiseSpectrum& spectrum, double std_dev, double rate_hz, std::uint64_t seed);

  double Next();
  void AddTo(std::span<double> signal) {
    for (double& x : signal) x += Next();
  }

 private:
  RandomStream stream_{0};
  // Of (x, x' / w) where the process has a derivative, else of x alone.
  std::array<double, 4> step_{};        // E, by rows
  std::array<double, 3> innovation_{};  // lower triangle of a square root of P - E P E^T
  std::array<double, 2> state_{};
};

}  // namespace howl

#endif  // HOWL_MODEL_NOISE_NOISE_PROCESS_H_
