// The slow amplitudes of p' and p that effects feel: the root of twice an exponential mean of the
// squares, over a memory of a few cycles.
#ifndef HOWL_MODEL_SIMULATION_SLOW_AMPLITUDES_H_
#define HOWL_MODEL_SIMULATION_SLOW_AMPLITUDES_H_

#include <span>

#include "model/loop/loop_effect.h"

namespace howl::internal {

class SlowAmplitudes {
 public:
  SlowAmplitudes() = default;
  explicit SlowAmplitudes(double first_mode_hz);

  // rate, pressure: p' and p up to the present, of which the last kLoopBlock are new, or all at the
  // beginning, where the past is known.
  void Update(std::span<const double> rate, std::span<const double> pressure, bool beginning,
              double step_s, LoopContext* context);

 private:
  double memory_s_ = 0.0;
  double rate_square_ = 0.0;
  double pressure_square_ = 0.0;
};

}  // namespace howl::internal

#endif  // HOWL_MODEL_SIMULATION_SLOW_AMPLITUDES_H_
