// The signals by which a record shows slow changes (slow_changes.h).
//
// All modes change alike. What each of them holds of p (modal_parts.h), and what the flame gives
// out but for noise, is told by a loop that was fitted before:
//
//   damping     Z = a_1 sum_i R_i / R (omega_i / omega_1) F[m x_i']
//   frequency   Z = a_1 sum_i R_i / R (omega_i / omega_1)^2 F[m (x_i + xi_i / omega_i x_i')]
//   delay       Y = F[m q']
//   gain        Y = -F[m q]
//
// F is the transform, mode 1 the cycle's, and where omega moves 2 xi omega does: without that a
// drift of 0.9 % leaves 1 000 nats of 12 900. Recorded q in the place of what the flame gives out
// would have noise move with the delay, which it does not: half of an effect would be missed.
// Before a loop was fitted p is one mode's, and of recorded q the parts near the cycle's lines are
// taken.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SLOW_SLOW_SIGNALS_H_
#define HOWL_ESTIMATION_RECORD_FIT_SLOW_SLOW_SIGNALS_H_

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// Where m of a drift begins and ends: for a part of a record with the whole one's m.
struct DriftRange {
  double from = -0.5;
  double to = 0.5;
};

// Sets those of the changes that the structure has, of the record's middle as well. fitted: the
// loop, or none; one whose flame is not of the record's functions says what modes hold alone.
void SetSlowSignals(const PointStructure& structure, const LoopPoint* fitted,
                    const DriftRange& drift, RecordSpectra* record);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SLOW_SLOW_SIGNALS_H_
