// Samples that one channel lost, from the other channel and from what stands beside the gap.
//
//   x_t = c + sum_k h_k y_(t-k) + e_t,   k = -3 ... 20 periods of the cycle, -200 ... 1000 at most
//
// Acoustics answer linearly, so that recorded q tells p but for noise, whatever the instruments'
// transfers are; h and c are those of least squares over the samples that are there. Of e the
// conditional mean is taken, given what it is within three periods of the gap, as of a normal
// process with the autocovariance of the samples that are there (Blackman and Tukey 1958: lags
// under a window, without negative powers). Where both channels have gaps, each is first filled by
// its own autocovariance alone, and then from the other, in turn.
//
// Gaps must fall where they do by chance: of a signal that is cut off at its peaks least squares
// see none of these, and h is not that of the peaks.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_FILL_GAPS_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_FILL_GAPS_H_

#include <vector>

#include "estimation/analysis/spectra/gap.h"
#include "estimation/analysis/spectra/record.h"

namespace howl {

// Gaps in the order of time. The record is cut where gaps lie so near its ends that what y was
// before or after the record matters: at most 20 periods go there, a sixteenth of the record.
Record WithGapsFilled(Record record, const std::vector<Gap>& pressure,
                      const std::vector<Gap>& heat_release, double cycle_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_FILL_GAPS_H_
