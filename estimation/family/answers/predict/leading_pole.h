// The pole with the largest growth rate of a loop at rest, for maps: the rightmost root of
//
//   1 = k L(s),   k = Phi'(0)
//
// among those that some slope of k's sign brings to the imaginary axis, each at a phase crossing of
// L (model/crossings.h), from where oscillation_pole.h follows it to k; and among those that start
// at the modes' own poles. A root that no slope brings to the axis is stable, so that
//
//   growth rate > 0  exactly where the loop is unstable at rest
//   growth rate = 0  exactly where |L(j 2 pi f) k| = 1 at a crossing f, and no other grows (1b)
//
// Below zero a root of the delay's may now and then lie further to the right: the loop is stable
// all the same. All poles are those of model/poles.h; this is far faster.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_LEADING_POLE_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_LEADING_POLE_H_

#include <optional>

#include "model/loop/poles.h"

namespace howl {

// flame_slope < 0. Crossings up to three times the last mode's natural frequency count: further up
// |k L| is nearly |k| (N + M), which is below one. No value where no root could be followed.
std::optional<Pole> LeadingPole(const LoopParameters<double>& loop, double flame_slope);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_LEADING_POLE_H_
