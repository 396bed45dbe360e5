// The amplitude of AmplitudeSense in time: mean squares of successive blocks through equal lags.
#ifndef HOWL_MODEL_EFFECTS_FORMS_LAGGED_AMPLITUDE_H_
#define HOWL_MODEL_EFFECTS_FORMS_LAGGED_AMPLITUDE_H_

#include <cmath>
#include <vector>

#include "model/effects/effect.h"

namespace howl {

class LaggedAmplitude {
 public:
  explicit LaggedAmplitude(const AmplitudeSense& sense)
      : lag_s_(sense.memory_s / sense.lags), lags_(static_cast<std::size_t>(sense.lags)) {}

  // The first square is that of all the past.
  double Next(double mean_square, double block_s) {
    if (squares_.empty()) squares_.assign(lags_, mean_square);
    const double keep = std::exp(-block_s / lag_s_);
    double in = mean_square;
    for (double& square : squares_) in = square = keep * square + (1.0 - keep) * in;
    return std::sqrt(2.0 * in);
  }

 private:
  double lag_s_;
  std::size_t lags_;
  std::vector<double> squares_;
};

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_FORMS_LAGGED_AMPLITUDE_H_
