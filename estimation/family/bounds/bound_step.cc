#include "estimation/family/bounds/bound_step.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

#include "estimation/family/bounds/bound_members.h"
#include "estimation/family/bounds/bound_split.h"

namespace howl {

namespace {

void PushWhereItReaches(const BoundContext& context, BoundSearch& search, Cell&& cell) {
  cell.bound = context.Reach(search.quantity, cell);
  if (cell.bound <= search.inner) {
    ++search.counts.undecided;
    return;
  }
  PushCell(search, std::move(cell));
}

void Start(const BoundContext& context, double scale, BoundSearch& search) {
  search.state = SearchState::kRunning;
  if (context.root_empty) {
    ++search.counts.outside;
  } else {
    DrawTowardsBound(context, search);
    ClimbTowardsBound(context, scale, search);
    PushWhereItReaches(context, search, Cell(context.root));
  }
}

void Finish(const BoundContext& context, BoundSearch& search, SearchState state) {
  search.state = state;
  search.outer = OuterSoFar(search);
  const BoundQuantity& quantity = search.quantity;
  VLOG(2) << (quantity.sign > 0.0 ? "highest " : "lowest ")
          << context.problem.experiments[quantity.experiment].name << "."
          << (quantity.expression ? "expression" : FamilyParameterName(quantity.parameter))
          << ": a member at " << quantity.sign * search.inner << ", none beyond "
          << quantity.sign * search.outer << "; " << search.cells << " boxes"
          << (state == SearchState::kClosed ? "" : ", all that it may take");
  (state == SearchState::kClosed ? search.counts.undecided : search.counts.pending) +=
      search.heap.size();
  search.heap.clear();
  search.heap.shrink_to_fit();
}

void SplitFarthest(const BoundContext& context, BoundSearch& search) {
  Cell cell = PopFarthestCell(search);
  ++search.cells;
  DrawInCell(context, cell, search);
  Interval* const split = ChooseSplit(context, search.quantity, cell);
  if (split == nullptr) {
    ++search.counts.undecided;
    search.finest_reach = std::max(search.finest_reach, cell.bound);
    return;
  }
  for (const Interval& half : Halves(*split)) {
    *split = half;
    Cell child = cell;
    if (context.contractor.Contract(child)) {
      PushWhereItReaches(context, search, std::move(child));
    } else {
      ++search.counts.outside;
    }
  }
}

}  // namespace

double BoundTolerance(const BoundLimits& limits, const BoundSearch& search) {
  return 0.5 * limits.width * search.range;
}

void StepBound(const BoundContext& context, const BoundLimits& limits, BoundSearch& search) {
  const double tolerance = BoundTolerance(limits, search);
  if (search.state == SearchState::kNew) {
    return Start(context, tolerance / (0.5 * limits.width), search);
  }
  if (search.heap.empty() || search.heap.front().bound <= search.inner + tolerance) {
    return Finish(context, search, SearchState::kClosed);
  }
  if (search.cells >= limits.max_cells) return Finish(context, search, SearchState::kBudget);
  SplitFarthest(context, search);
}

}  // namespace howl
