// The place of a gap that no effect of the catalogue explains: each block of the loop in turn is
// given slack (free_slack.h, free_map.h), base and slack are fitted together, and the block whose
// slack gains most, less the price of its parameters, is the place. Some places are found without a
// fit: that of coherent lines by the ratio of what they leave over in the two cuts
// (coherent_lines.h); that of fluctuations of the flame's response in phase (gain: flame) or in
// quadrature (delay); that of few levels and sharp edges of a
// channel, detected in its samples.
#ifndef HOWL_DIAGNOSIS_LOCALISE_LOCALISE_H_
#define HOWL_DIAGNOSIS_LOCALISE_LOCALISE_H_

#include <string>
#include <vector>

#include "diagnosis/candidates/attempt.h"

namespace howl {

struct BlockSlack {
  LoopBlock block = LoopBlock::kAcoustics;
  std::string form;
  double gain = 0.0;        // of log-likelihood over the base, less half a log(data) a parameter
  bool model_free = false;  // in the samples themselves
  double low_hz = 0.0;      // where it takes most off; zeros: nowhere in particular
  double high_hz = 0.0;
};

// Tries every form of every block; nothing in it is random.
std::vector<BlockSlack> Localise(const AttemptContext& at, const std::vector<CoherentLine>& lines,
                                 const LineOrigin& origin, const GainFluctuation& fluctuation,
                                 int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_LOCALISE_H_
