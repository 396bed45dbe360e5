// xi does not fall as phi grows: a chain of order relations between the experiments. On intervals
// the chain is solved exactly by two running bounds: after PropagateChain every value that is left
// in one interval has partners in all the others.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_CHAIN_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_CHAIN_H_

#include <algorithm>
#include <span>

#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/targets.h"

namespace howl {

// Experiments of equal phi are not ordered among themselves. False when the chain is empty.
inline bool PropagateChain(std::span<const ExperimentTarget> targets, bool increasing,
                           std::span<Range> xi) {
  const std::size_t n = xi.size();
  if (increasing) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (targets[j].phi < targets[i].phi) xi[i].lo = std::max(xi[i].lo, xi[j].lo);
        if (targets[j].phi > targets[i].phi) xi[i].hi = std::min(xi[i].hi, xi[j].hi);
      }
    }
  }
  for (const Range& range : xi) {
    if (!(range.lo <= range.hi)) return false;
  }
  return true;
}

// Fixes xi[index] and narrows the others accordingly.
inline void FixInChain(std::span<const ExperimentTarget> targets, bool increasing,
                       std::size_t index, double value, std::span<Range> xi) {
  xi[index] = {value, value};
  if (!increasing) return;
  for (std::size_t j = 0; j < xi.size(); ++j) {
    if (targets[j].phi > targets[index].phi) xi[j].lo = std::max(xi[j].lo, value);
    if (targets[j].phi < targets[index].phi) xi[j].hi = std::min(xi[j].hi, value);
  }
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_CHAIN_H_
