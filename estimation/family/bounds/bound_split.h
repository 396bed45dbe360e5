// Chooses the variable in which a cell is halved in the search for a bound. A variable's width
// counts relative to the root cell's,
//
//   score = weight * width / root width      (of the logarithms, where the root spans decades)
//
// with weights that prefer the variables of the experiments that the quantity depends on. Of the
// variables with the largest scores, the one whose halves reach least far, or simply the first.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_SPLIT_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_SPLIT_H_

#include <array>

#include "estimation/family/bounds/bound_context.h"
#include "estimation/family/bounds/bound_quantity.h"
#include "estimation/family/bounds/contract/cell.h"

namespace howl {

// A variable of `cell`; nullptr where all are too fine to split. The cell is the same afterwards.
Interval* ChooseSplit(const BoundContext& context, const BoundQuantity& quantity, Cell& cell);

// The lower half, then the upper: geometric where the interval spans more than a factor of four.
std::array<Interval, 2> Halves(const Interval& x);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_SPLIT_H_
