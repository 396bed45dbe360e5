// The state of the search for one bound. For the quantity sign * value
// (estimation/family/bounds/bound_quantity.h), over all members,
//
//   inner  <=  largest sign * value  <=  outer  =  max(inner, finest_reach, reach of the heap)
//
// with `inner` the value of the best member found, and `outer` widened by the rounding of the test.
// No member found: inner = -infinity. Nothing proved: outer = +infinity.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_SEARCH_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_SEARCH_H_

#include <cstddef>
#include <vector>

#include "estimation/family/bounds/bound_context.h"
#include "estimation/family/bounds/bound_quantity.h"
#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/problem/random.h"

namespace howl {

inline constexpr double kBoundRounding = 1e-12;  // of a bound: the test is evaluated in doubles

enum class SearchState { kNew, kRunning, kClosed, kBudget };

struct BoundSearch {
  BoundQuantity quantity;
  double range = 0.0;  // of the value over the members to start from
  SearchState state = SearchState::kNew;
  double inner = -kUnbounded;         // sign * value, of `witness`
  double finest_reach = -kUnbounded;  // sign * reach of cells too fine to split
  double outer = kUnbounded;          // sign * value, once the search has ended
  Member witness;                     // empty: none was found
  DrawFocus focus;                    // of the best member
  UnitRandom random{0, 0};
  std::vector<Cell> heap;  // by reach, the farthest first
  CellCounts counts;
  std::size_t cells = 0;  // that were split, or too fine to be

  bool IsDone() const { return state == SearchState::kClosed || state == SearchState::kBudget; }
};

// Appends the searches for the lower and the upper end of the quantity, whose sign is not looked
// at. The draws of a search depend on its place among all.
void AddBothEnds(const BoundContext& context, BoundQuantity quantity,
                 std::vector<BoundSearch>& searches);

// The farthest that the search may still reach: by its best member, by the cells that are too fine
// to split, and by those of its heap.
double OuterSoFar(const BoundSearch& search);

// Orders cells of the heap by their reach.
void PushCell(BoundSearch& search, Cell&& cell);
Cell PopFarthestCell(BoundSearch& search);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_SEARCH_H_
