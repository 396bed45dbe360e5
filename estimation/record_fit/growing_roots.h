// How many roots of the loop about its present state grow:
//
//   1 - phi_0 U(s) = 0,   Re s > 0,   U = R e^(-tau s) V(s)     phi_0: return_difference.h
//
// by the argument principle (Nyquist 1932): R's poles are stable, and so the phase of 1 - phi_0 U
// falls by pi for each such root as s runs up the imaginary axis.
//
// A spectrum cannot tell a loop from the one with acoustics and flame exchanged, R' = 1 / F and
// F' = 1 / R, whose sources are others: the likelihood of whole spectra has a maximum near each.
// What tells them apart is that a rig which is there does not diverge: of the two, one has roots
// that grow at all frequencies.
#ifndef HOWL_ESTIMATION_RECORD_FIT_GROWING_ROOTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_GROWING_ROOTS_H_

#include "estimation/record_fit/loop_point.h"

namespace howl {

// Conjugate roots count as two. Of frequencies up to the end of the record's band.
int GrowingRoots(const RecordSpectra& record, const LoopPoint& point);

// A rig that was recorded does not diverge. In a cycle the flame's mean slope may leave the cycle's
// own pair of roots growing, where the flame is steeper in the cycle than at rest.
inline bool Diverges(const RecordSpectra& record, const LoopPoint& point) {
  return GrowingRoots(record, point) > 2;
}

// A hundred radians are sixteen periods of the cycle: no rig's delay, and the wild step of a
// search.
inline bool IsWild(const LoopPoint& point) { return !(point.tau < 100.0); }

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_GROWING_ROOTS_H_
