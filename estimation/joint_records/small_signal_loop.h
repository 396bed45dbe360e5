// The loop of small signals about rest, of an operating point whose loop is known from its record:
//
//   slope U(s) = 1,   U = R(s) e^(-tau s) V(s),   slope: d q / d v at v = 0
//
// has a root near the cycle's frequency, s = (sigma + j omega) / omega_cycle: below onset it
// decays, in a limit cycle it grew until the flame saturated. |slope U| at the frequency at which U
// is positive is the loop's gain (the paper's |L Phi'(0)|, (1b)). Intervals are the first-order
// ones of the fit's covariance.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_SMALL_SIGNAL_LOOP_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_SMALL_SIGNAL_LOOP_H_

#include "estimation/analysis/spectra/statistics.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

struct SmallSignalLoop {
  Estimate frequency_hz;
  Estimate growth_rate_1_s;
  Estimate loop_gain;  // at the root's frequency
  bool found = false;  // that Newton's method came to a root within half an octave of the cycle
};

SmallSignalLoop SmallSignalLoopOf(const RecordSpectra& record, const PointStructure& structure,
                                  const PointFit& fit);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_SMALL_SIGNAL_LOOP_H_
