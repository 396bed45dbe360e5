// Where the gap lies: shares of the loop's blocks, the band, and the experiments.
#ifndef HOWL_DIAGNOSIS_LOCALISE_PLACE_H_
#define HOWL_DIAGNOSIS_LOCALISE_PLACE_H_

#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/gap/slack.h"
#include "diagnosis/localise/localise.h"

namespace howl {

// Blocks are ranked by the probability of the effects that act there; where no effect explains the
// gap, by what the effects and the free slack of each block would take off it.
std::vector<Place> FindPlaces(const std::vector<CutRecord>& records,
                              const std::vector<Attempt>& attempts, VerdictKind kind,
                              const Slack& before, const std::vector<BlockSlack>& blocks);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_PLACE_H_
