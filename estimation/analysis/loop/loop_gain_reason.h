// Why the loop gain at rest comes out below one although the loop is in a limit cycle. At the
// cycle the describing function's loop gain is one, |G| 2 pi f D(X) = 1 (1b), so that
//
//   loop gain at rest = Phi'(0) / D(X) = 1 - 3 r_3 + 5 r_5 - ...
//
// with r_k the mean cycle's harmonics of q (flame_curve.h). A flame that saturates has r_3 < 0 and
// a loop gain above one; below one it is because
//   - it is steeper in the cycle than at rest: r_3 > 0. Then D grows with the amplitude,
//     d ln D / d ln X = 6 r_3 + 10 r_5 > 0, so that this curve is not what limits the cycle;
//   - it has a memory, or what lies between it and the record disperses: r_3 is turned by more than
//     45 degrees, and the curve of q over dp/dt is not Phi;
//   - noise of p flattens the curve.
#ifndef HOWL_ESTIMATION_ANALYSIS_LOOP_LOOP_GAIN_REASON_H_
#define HOWL_ESTIMATION_ANALYSIS_LOOP_LOOP_GAIN_REASON_H_

#include <cstdint>
#include <optional>
#include <string_view>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/analysis/flame/flame_curve.h"

namespace howl {

enum class LoopGainReason : std::uint8_t { kSteeperInCycle, kMemory, kNoise, kNotExplained };
std::string_view LoopGainReasonName(LoopGainReason reason);  // as in files

struct LowLoopGain {
  LoopGainReason reason = LoopGainReason::kNotExplained;
  double third_harmonic = 0.0;   // Re r_3
  double turn_deg = 0.0;         // arg r_3: zero where r_3 > 0 without memory
  double shape_gain = 1.0;       // 1 - 3 Re r_3 + 5 Re r_5
  double stiffening = 0.0;       // d ln D / d ln X
  double regressor_noise = 0.0;  // s^2 / X^2
};

// No value where there is no stationary or drifting limit cycle, or where the 95 % interval of the
// loop gain reaches one. A reason is given where it accounts for at least half of what is missing
// to one.
std::optional<LowLoopGain> ExplainLowLoopGain(const Characteristics& cycle, const FlameCurve& curve,
                                              const Estimate& loop_gain);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_LOOP_LOOP_GAIN_REASON_H_
