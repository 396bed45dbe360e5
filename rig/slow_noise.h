// Random signals on the grid, and the slow amplitude of a signal.
#ifndef HOWL_RIG_SLOW_NOISE_H_
#define HOWL_RIG_SLOW_NOISE_H_

#include <cmath>
#include <numbers>

#include "rig/random.h"

namespace rig {

inline constexpr double kEnvelopeCycles = 2.0;

// Coloured noise that is continuous: white through two lags, of the wanted rms.
class Noise {
 public:
  Noise(double rms, double corner_hz, double second_hz, double step_s, Random random)
      : random_(random) {
    keep_ = std::exp(-2.0 * std::numbers::pi * corner_hz * step_s);
    second_ = std::exp(-2.0 * std::numbers::pi * second_hz * step_s);
    // Variance of y = b y + (1 - b) x, x = a x + e with unit variance: (1 - b) (1 + a b) /
    // ((1 + b) (1 - a b)).
    const double variance =
        (1.0 - second_) * (1.0 + keep_ * second_) / ((1.0 + second_) * (1.0 - keep_ * second_));
    scale_ = rms / std::sqrt(variance);
    kick_ = std::sqrt(1.0 - keep_ * keep_);
    x_ = random_.Normal();
    y_ = x_;
  }
  double Next() {
    x_ = keep_ * x_ + kick_ * random_.Normal();
    y_ = second_ * y_ + (1.0 - second_) * x_;
    return scale_ * y_;
  }

 private:
  Random random_;
  double keep_ = 0.0;
  double second_ = 0.0;
  double scale_ = 0.0;
  double kick_ = 0.0;
  double x_ = 0.0;
  double y_ = 0.0;
};

// Slow amplitude of a signal: the root of twice its mean square over two cycles or so.
class Envelope {
 public:
  Envelope(double cycle_hz, double step_s, double start)
      : keep_(std::exp(-step_s * cycle_hz / kEnvelopeCycles)),
        first_(start * start),
        second_(first_) {}
  double Next(double value) {
    first_ = keep_ * first_ + (1.0 - keep_) * 2.0 * value * value;
    second_ = keep_ * second_ + (1.0 - keep_) * first_;
    return std::sqrt(second_);
  }

 private:
  double keep_;
  double first_;
  double second_;
};

}  // namespace rig

#endif  // HOWL_RIG_SLOW_NOISE_H_
