// Draws from ranges, for the member drawer.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_RANGE_DRAW_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_RANGE_DRAW_H_

#include <algorithm>

#include "estimation/family/problem/random.h"
#include "estimation/family/problem/targets.h"

namespace howl {

inline Range Intersection(const Range& a, const Range& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

inline bool IsEmpty(const Range& range) { return !(range.lo <= range.hi); }

// A draw from a range, or one of its ends.
inline double Pick(UnitRandom& random, const Range& range, double end) {
  if (end == 0.0) return range.lo;
  if (end == 1.0) return range.hi;
  return random.Uniform(range);
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_RANGE_DRAW_H_
