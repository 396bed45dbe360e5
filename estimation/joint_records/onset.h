// Where small oscillations begin to grow, from the loops of several operating points, below onset
// or above it: where the straight line through the gains of their loops about rest reaches one
// (vanishing_phi.h), and by the straight line through their frequencies at which frequency.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_ONSET_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_ONSET_H_

#include <span>

#include "estimation/analysis/loop/vanishing_phi.h"
#include "estimation/joint_records/small_signal_loop.h"

namespace howl {

struct OnsetPoint {
  double operating_parameter = 0.0;
  SmallSignalLoop loop;
};

struct Onset {
  VanishingPhi at;        // needs three points whose root was found
  Estimate frequency_hz;  // NaN where `at` has an end that is infinite
};

Onset OnsetOf(std::span<const OnsetPoint> points);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_ONSET_H_
