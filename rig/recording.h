// From true signals to a record: instruments, anti-alias filter (the same for both channels, no
// phase), sensor noise, digitisers.
#ifndef HOWL_RIG_RECORDING_H_
#define HOWL_RIG_RECORDING_H_

#include "rig/march.h"

namespace rig {

struct Record {
  std::vector<double> p;
  std::vector<double> q;
};

// Steps that Digitise needs before the first sample and after the last.
std::size_t LeadSteps(const Plan& plan, const Grid& grid);

Record Digitise(const Plan& plan, std::size_t point, const Grid& grid, const TrueSignals& signals,
                std::size_t samples, double sampling_hz, std::uint64_t seed);

}  // namespace rig

#endif  // HOWL_RIG_RECORDING_H_
