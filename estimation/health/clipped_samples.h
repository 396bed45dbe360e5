// Samples of p that a converter, or an amplifier before it, cut off at the ends of its range. They
// are drawn from what q and the samples beside them tell (draw_clipped.h), and the loop is fitted
// to what comes of it, with the power of their errors as noise of p's sensor. q cannot be made good
// in this way: the acoustics turn p's noise into more than what is known of q's cycle
// (docs/validation.md). Where noise came to p behind the range, its samples do not say which were
// lost, and stay.
#ifndef HOWL_ESTIMATION_HEALTH_CLIPPED_SAMPLES_H_
#define HOWL_ESTIMATION_HEALTH_CLIPPED_SAMPLES_H_

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "estimation/joint_records/loop_record.h"

namespace howl {

// Of a sine's samples those beyond half its amplitude.
inline constexpr double kMostClipped = 2.0 / 3.0;

// At the largest and the smallest value, where these stand too often (sample_health.h).
double ShareClipped(std::span<const double> pressure);

// Records of which more than that is clipped stay as they are, and all where p_clipping is
// withheld.
std::vector<LoopRecord> WithClippedSamplesDrawn(std::vector<LoopRecord> records,
                                                const std::vector<std::string>& withheld,
                                                std::uint64_t seed, int threads);

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_CLIPPED_SAMPLES_H_
