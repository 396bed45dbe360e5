// Noise of a rig. Combustion noise n is added to the heat release inside the loop,
// q = Phi(p'(t - tau)) + n, with the one-sided power spectral density
//
//   S(f) = S0 / (1 + (f / f_c)^2)    in (units of q)^2 / Hz
//
// an Ornstein-Uhlenbeck process of variance S0 f_c pi / 2, sampled exactly at the internal rate
// f_i: what it has beyond f_i / 2 folds back, (pi f_c / f_i)^2 / 3 of S0 (3 % for f_c = f_i / 10).
// With f_c infinite it is white up to f_i / 2, of variance S0 f_i / 2: since q acts on p'
// directly, white noise without a band has no meaning for this loop, and the internal rate is then
// a part of the model.
//
// Sensor noise is white, added to each recorded sample.
#ifndef HOWL_MODEL_NOISE_NOISE_H_
#define HOWL_MODEL_NOISE_NOISE_H_

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "model/noise/random_stream.h"

namespace howl {

struct Noise {
  double combustion_density = 0.0;                                        // S0, (units of q)^2 / Hz
  double combustion_corner_hz = std::numeric_limits<double>::infinity();  // f_c
  double pressure_sensor_std = 0.0;                                       // units of p
  double heat_release_sensor_std = 0.0;                                   // units of q
};

// A first-order process with the spectrum above, one sample a step; starts stationary.
class ColouredNoise {
 public:
  ColouredNoise(double density, double corner_hz, double rate_hz, std::uint64_t seed)
      : stream_(seed) {
    if (std::isinf(corner_hz)) {
      innovation_ = std::sqrt(0.5 * density * rate_hz);
    } else {
      const double std_dev = std::sqrt(0.5 * std::numbers::pi * density * corner_hz);
      decay_ = std::exp(-2.0 * std::numbers::pi * corner_hz / rate_hz);
      innovation_ = std_dev * std::sqrt(1.0 - decay_ * decay_);
      if (density > 0.0) value_ = std_dev * stream_.Normal();
    }
  }

  double Next() {
    value_ = decay_ * value_ + innovation_ * stream_.Normal();
    return value_;
  }

 private:
  RandomStream stream_;
  double decay_ = 0.0;
  double innovation_ = 0.0;
  double value_ = 0.0;
};

}  // namespace howl

#endif  // HOWL_MODEL_NOISE_NOISE_H_
