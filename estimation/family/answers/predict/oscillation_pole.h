// The pole that carries the loop's oscillation: the root of
//
//   1 = k L(s),   k = Phi'(0)
//
// that stands on the imaginary axis at the phase crossing f when k is just steep enough, k_0 = -1 /
// |L(j 2 pi f)|, and is followed from there to k along ds / d(ln k) = -L / L'(s), with a correction
// by Newton's method at each step. Where the phase of L falls through 180 degrees at f it grows
// exactly where |L Phi'(0)| > 1 (1b). Other poles, which may lie further to the right, are those of
// model/loop/poles.h; one root is far cheaper than all.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_OSCILLATION_POLE_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_OSCILLATION_POLE_H_

#include <optional>

#include "model/loop/poles.h"

namespace howl {

// flame_slope < 0; crossing_hz: where arg L is 180 degrees. No value where the way to the slope is
// too long (a factor of 1000) or Newton fails on it.
std::optional<Pole> OscillationPole(const LoopParameters<double>& loop, double flame_slope,
                                    double crossing_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_OSCILLATION_POLE_H_
