// One step of the best-first search for a bound: the cell that reaches farthest is split in two,
// each half is contracted, and what no longer reaches beyond the best member is dropped. The search
// closes when
//
//   reach of the farthest cell  <=  inner + tolerance,     tolerance = width / 2 * range,
//
// and gives up when its budget of cells is spent; `outer` is then what the cells left still reach.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_STEP_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_STEP_H_

#include <cstddef>

#include "estimation/family/bounds/bound_context.h"
#include "estimation/family/bounds/bound_search.h"

namespace howl {

struct BoundLimits {
  double width = 0.0;  // of both ends together, relative to the range of the search
  std::size_t max_cells = 0;
};

double BoundTolerance(const BoundLimits& limits, const BoundSearch& search);

// The first step looks for members and pushes the root cell. The search must not be done.
void StepBound(const BoundContext& context, const BoundLimits& limits, BoundSearch& search);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_STEP_H_
