// Every phase crossing of a fitted loop in the band that its modes cover, compared with what was
// observed: the limit cycle and the experiment's lines. Section 4 of the paper explains a line by a
// second crossing with magnitude above one, so that its frequency and its size both count.
#ifndef HOWL_ESTIMATION_FIT_LOOP_CROSSINGS_H_
#define HOWL_ESTIMATION_FIT_LOOP_CROSSINGS_H_

#include <optional>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "model/loop/crossings.h"

namespace howl {

struct ObservedCrossing {
  PhaseCrossing crossing;  // gain: NaN where the flame slope is not known
  // The cycle or line that lies nearest to this crossing, where this is its nearest crossing too.
  std::optional<double> observed_hz;
  double phase_error_deg = 0.0;  // arg L - 180 degrees there, wrapped
  double observed_gain = 0.0;    // |L Phi'(0)| there; NaN where the flame slope is not known
};

// The crossings in the order of frequency, up to the end of the transfer's band
// (estimation/analysis/transfer/transfer.h) or a little beyond the highest line.
std::vector<ObservedCrossing> LoopCrossings(const Experiment& experiment, const LoopModel& model,
                                            const ModelSpec& spec);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_LOOP_CROSSINGS_H_
