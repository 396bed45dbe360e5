#include "model/simulation/slow_amplitudes.h"

#include <cmath>

#include "model/simulation/cycle_scale.h"
#include "model/simulation/lane_loop.h"

namespace howl::internal {
namespace {

constexpr double kAmplitudeMemory_s = 0.02;  // of a first mode at the paper's 220 Hz

}  // namespace

SlowAmplitudes::SlowAmplitudes(double first_mode_hz)
    : memory_s_(kAmplitudeMemory_s / CycleScale(first_mode_hz)) {}

void SlowAmplitudes::Update(std::span<const double> rate, std::span<const double> pressure,
                            bool beginning, double step_s, LoopContext* context) {
  double rate_sum = 0.0;
  double pressure_sum = 0.0;
  for (std::size_t i = rate.size() - kLoopBlock; i < rate.size(); ++i) {
    rate_sum += rate[i] * rate[i];
    pressure_sum += pressure[i] * pressure[i];
  }
  const double keep = std::exp(-kLoopBlock * step_s / memory_s_);
  if (beginning) {
    const auto count = static_cast<double>(rate.size());
    rate_square_ = pressure_square_ = 0.0;
    for (std::size_t i = 0; i < rate.size(); ++i) {
      rate_square_ += rate[i] * rate[i] / count;
      pressure_square_ += pressure[i] * pressure[i] / count;
    }
  } else {
    rate_square_ = keep * rate_square_ + (1.0 - keep) * rate_sum / kLoopBlock;
    pressure_square_ = keep * pressure_square_ + (1.0 - keep) * pressure_sum / kLoopBlock;
  }
  context->rate_square = beginning ? rate_square_ : rate_sum / kLoopBlock;
  context->pressure_square = beginning ? pressure_square_ : pressure_sum / kLoopBlock;
  context->rate_amplitude = std::sqrt(2.0 * rate_square_);
  context->pressure_amplitude = std::sqrt(2.0 * pressure_square_);
}

}  // namespace howl::internal
