#include "model/noise/noise_process.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/units.h"

namespace howl {

double NoiseSpectrum::DensityPerSquare(double f_hz, double rate_hz) const {
  const double u = f_hz / frequency_hz;
  switch (colour) {
    case NoiseColour::kWhite:
      return 2.0 / rate_hz;
    case NoiseColour::kLowPass:
      return 2.0 / (std::numbers::pi * frequency_hz) / (1.0 + u * u);
    case NoiseColour::kResonance:
      break;
  }
  const double off = 1.0 - u * u;
  const double damped = 2.0 * damping * u;
  return 4.0 * damping / (std::numbers::pi * frequency_hz) / (off * off + damped * damped);
}

NoiseProcess::NoiseProcess(const NoiseSpectrum& spectrum, double std_dev, double rate_hz,
                           std::uint64_t seed)
    : stream_(seed) {
  CHECK_GE(std_dev, 0.0);
  if (spectrum.colour == NoiseColour::kWhite) {
    innovation_[0] = std_dev;
    return;
  }
  CHECK_GT(spectrum.frequency_hz, 0.0);
  const double angle = kRadPerSPerHz * spectrum.frequency_hz / rate_hz;
  if (spectrum.colour == NoiseColour::kLowPass) {
    const double decay = std::exp(-angle);
    step_[0] = decay;
    innovation_[0] = std_dev * std::sqrt(-std::expm1(-2.0 * angle));
    state_[0] = std_dev * stream_.Normal();
    return;
  }
  const double zeta = spectrum.damping;
  CHECK(zeta > 0.0 && zeta < 1.0) << zeta;
  const double root = std::sqrt(1.0 - zeta * zeta);
  const double decay = std::exp(-zeta * angle);
  const double c = decay * std::cos(root * angle);
  const double s = decay * std::sin(root * angle) / root;
  step_ = {c + zeta * s, s, -s, c - zeta * s};
  // P is std_dev^2 times one, in (x, x' / w).
  const double xx = 1.0 - step_[0] * step_[0] - step_[1] * step_[1];
  const double xv = -step_[0] * step_[2] - step_[1] * step_[3];
  const double vv = 1.0 - step_[2] * step_[2] - step_[3] * step_[3];
  const double first = std::sqrt(std::max(xx, 0.0));
  const double across = first > 0.0 ? xv / first : 0.0;
  innovation_ = {std_dev * first, std_dev * across,
                 std_dev * std::sqrt(std::max(vv - across * across, 0.0))};
  state_ = {std_dev * stream_.Normal(), std_dev * stream_.Normal()};
}

double NoiseProcess::Next() {
  const double first = stream_.Normal();
  const double x = step_[0] * state_[0] + step_[1] * state_[1] + innovation_[0] * first;
  double v = step_[2] * state_[0] + step_[3] * state_[1];
  if (innovation_[2] != 0.0) v += innovation_[1] * first + innovation_[2] * stream_.Normal();
  state_ = {x, v};
  return x;
}

}  // namespace howl
