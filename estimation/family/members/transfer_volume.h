// The effect of a condition on the transfer on the family's volume: the ratio of the Lebesgue
// volumes (of the free natural parameters, as in estimation/family/members/sample.h) with and
// without transfer_distance_max.
//
// The ratio is far too small for a share of draws. Members are taken from the family without the
// condition to the one with it through a row of distances, each the 30 % quantile of the largest
// distance over the experiments among the members at the one before (subset simulation; Au, Beck
// 2001); the logarithms of the shares add up. Sampled, not guaranteed.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_TRANSFER_VOLUME_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_TRANSFER_VOLUME_H_

#include <cstdint>
#include <optional>

#include "estimation/family/problem/problem.h"

namespace howl {

struct VolumeOptions {
  std::size_t population = 160;
  std::size_t sweeps = 6;  // a level
  std::size_t max_levels = 150;
  std::uint64_t seed = 0;
  int threads = 1;
};

struct TransferVolume {
  std::size_t experiments = 0;  // that have a transfer
  // Finite without the condition. Two modes of vanishing damping, or of unlimited size, cancel each
  // other at any size: then only a family with the condition has a volume.
  bool finite_without = true;
  std::optional<double> ln_ratio;  // nothing where no volume is finite, or a level was not reached
  double ln_std = 0.0;             // of the shares, as if the draws of a level were independent
  std::size_t levels = 0;
  // The smallest largest-distance that a model passing the other conditions was found with: beyond
  // transfer_distance_max, the transfers and the model contradict each other.
  std::optional<double> least_distance;
};

TransferVolume MeasureTransferVolume(const FamilyProblem& problem,
                                     const VolumeOptions& options = {});

// Without the condition.
FamilyProblem WithoutTransfer(const FamilyProblem& problem);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_TRANSFER_VOLUME_H_
