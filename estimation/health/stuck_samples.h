// Samples that a channel lost while it stood still (estimation/health/sample_health.h): they are
// filled from the other channel (fill_gaps.h), and the loop is fitted to what comes of it.
//
// What is filled in has no noise of the sensor and tells nothing new, so that the record counts for
// as much less (record_spectra.h): beyond a quarter what is left is not called enough.
#ifndef HOWL_ESTIMATION_HEALTH_STUCK_SAMPLES_H_
#define HOWL_ESTIMATION_HEALTH_STUCK_SAMPLES_H_

#include <span>
#include <string>
#include <vector>

#include "estimation/joint_records/loop_record.h"

namespace howl {

inline constexpr double kMostStuck = 0.25;

// Of one channel's samples.
double ShareStuck(std::span<const double> samples);

// Records of which at most that share is stuck are filled, but for the channels whose dropouts
// (p_dropouts, q_dropouts) are withheld.
std::vector<LoopRecord> WithStuckSamplesFilled(std::vector<LoopRecord> records,
                                               const std::vector<std::string>& withheld,
                                               int threads);

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_STUCK_SAMPLES_H_
