#include "estimation/family/bounds/bound_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace howl {

namespace {

bool ReachesLess(const Cell& a, const Cell& b) { return a.bound < b.bound; }

}  // namespace

void AddBothEnds(const BoundContext& context, BoundQuantity quantity,
                 std::vector<BoundSearch>& searches) {
  double lo = kUnbounded, hi = -kUnbounded;
  std::size_t lowest = 0, highest = 0;
  for (std::size_t k = 0; k < context.base.size(); ++k) {
    const double value = context.Value(quantity, context.base[k]);
    if (value < lo) lo = value, lowest = k;
    if (value > hi) hi = value, highest = k;
  }
  for (const double sign : {-1.0, 1.0}) {
    BoundSearch search;
    quantity.sign = sign;
    search.quantity = quantity;
    search.focus.experiment = quantity.experiment;
    search.random = UnitRandom(context.seed, 0x100000 + searches.size());
    if (lo <= hi) {
      search.inner = sign > 0.0 ? hi : -lo;
      search.witness = context.base[sign > 0.0 ? highest : lowest];
    }
    search.range = lo < hi ? hi - lo : (lo == hi ? 1e-6 * std::abs(lo) : 0.0);
    searches.push_back(std::move(search));
  }
}

double OuterSoFar(const BoundSearch& search) {
  double outer = std::max(search.inner, search.finest_reach);
  if (!search.heap.empty()) outer = std::max(outer, search.heap.front().bound);
  return std::isfinite(outer) ? outer + kBoundRounding * std::abs(outer) : outer;
}

void PushCell(BoundSearch& search, Cell&& cell) {
  search.heap.push_back(std::move(cell));
  std::push_heap(search.heap.begin(), search.heap.end(), ReachesLess);
}

Cell PopFarthestCell(BoundSearch& search) {
  std::pop_heap(search.heap.begin(), search.heap.end(), ReachesLess);
  Cell cell = std::move(search.heap.back());
  search.heap.pop_back();
  return cell;
}

}  // namespace howl
