// Records with what their instruments lost of them made good, as far as the other channel tells it.
#ifndef HOWL_ESTIMATION_HEALTH_MENDED_RECORDS_H_
#define HOWL_ESTIMATION_HEALTH_MENDED_RECORDS_H_

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "estimation/health/clipped_samples.h"
#include "estimation/health/stuck_samples.h"

namespace howl {

// Not what effects did that are withheld (p_dropouts, q_dropouts, p_clipping).
inline std::vector<LoopRecord> MendedRecords(std::vector<LoopRecord> records,
                                             const std::vector<std::string>& withheld,
                                             std::uint64_t seed, int threads) {
  return WithClippedSamplesDrawn(WithStuckSamplesFilled(std::move(records), withheld, threads),
                                 withheld, seed, threads);
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_MENDED_RECORDS_H_
