// Searches for members towards a bound, which widen the search's `inner`. Each function keeps a
// member that has a larger sign * value than the best so far. Not finding one proves nothing.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_MEMBERS_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_MEMBERS_H_

#include "estimation/family/bounds/bound_context.h"
#include "estimation/family/bounds/bound_search.h"
#include "estimation/family/bounds/contract/cell.h"

namespace howl {

// Draws at random at the ends of the tolerances, with shared parameters from ranges that shrink
// around the best.
void DrawTowardsBound(const BoundContext& context, BoundSearch& search);

// Draws within the part of the cell that all experiments share.
void DrawInCell(const BoundContext& context, const Cell& cell, BoundSearch& search);

// Climbs from the best member found and from some others to the farthest that a local search
// reaches; `scale`: a typical range of the quantity.
void ClimbTowardsBound(const BoundContext& context, double scale, BoundSearch& search);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_MEMBERS_H_
