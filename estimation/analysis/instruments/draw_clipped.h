// Samples of p beyond the ends of a converter's range, from q and from what stands beside them.
//
//   p_t = c + sum_k h_k q_(t-k) + e_t,   k as in fill_gaps.h
//
// Clipping takes samples away by their own values, so that least squares over those that are left
// would find h too small. They are of the times at which q alone tells that p lies inside the
// range, three deviations of e from its ends: which times these are does not hang on e.
//
// h is each half's own: what one half tells of the other is not what was put into both.
//
// What is lost is drawn: e as a normal process (autoregression.h), given e beside the lost samples
// and that p lies beyond the end (Gibbs sampling: one sample after the other, given all others). A
// mean in its place would lack the noise that the rest of the record has, which a loop's fit would
// miss. What e leaves of errors in h errs alike in all periods: at the cycle's lines, where a
// record is known best. Several draws of what such errors make of the lost samples stand beside the
// record.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_DRAW_CLIPPED_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_DRAW_CLIPPED_H_

#include <cstdint>
#include <limits>

#include "estimation/analysis/spectra/record.h"

namespace howl {

// The least value that clipping made too small, the largest that it made too large.
struct RangeEnds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

// The first and the last few periods, whose q before or after the record matters, are cut off. A
// record with too few times that tell h stays as it is. With n samples, K of h and M in use it
// takes K^2 M + K^3 / 3 steps, and for each draw of errors 4 K n.
Record WithClippedDrawn(Record record, const RangeEnds& pressure, double cycle_hz,
                        std::uint64_t seed);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_DRAW_CLIPPED_H_
