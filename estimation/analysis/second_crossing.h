// Which line of a record is the second crossing of the paper's section 4: a frequency at which the
// loop closes once more. With Delta_l = arg(P / Q) measured at the line f_l and tau that of the
// cycle, (1a) has to hold there too:
//
//   Delta_l + 90 - 360 f_l tau - 180 = 0 degrees, whole turns apart,
//
// and for the line to grow the loop gain at rest, 2 pi f_l |P / Q| |Phi'(0)|, has to exceed one. A
// line that the loop does not carry, such as a hum, a source in the duct, or a sum or difference of
// the cycle and a slow modulation, has a phase and a gain of its own and misses that.
#ifndef HOWL_ESTIMATION_ANALYSIS_SECOND_CROSSING_H_
#define HOWL_ESTIMATION_ANALYSIS_SECOND_CROSSING_H_

#include "estimation/analysis/analyse.h"

namespace howl {

// The left side in (-180, 180] degrees, with the errors of the line's phase and of tau; NaN without
// a delay or a phase.
Estimate LoopPhaseErrorAt(const Analysis& analysis, const SpectralLine& line);

// The loop gain at the line, from its ratio to the cycle's, which is known; NaN without a slope,
// zero where q does not show the line.
Estimate LoopGainAt(const Analysis& analysis, const SpectralLine& line);

// The strongest line of p that is no multiple of the cycle and lies above it (below lie differences
// of the two), if it is narrow and the loop closes there with a gain above one; else null. Weaker
// lines are sums and differences of the stronger, and one in six of them closes the loop by chance.
const SpectralLine* FindSecondCrossing(const Analysis& analysis);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SECOND_CROSSING_H_
