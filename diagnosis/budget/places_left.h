// Where a structure's predictions still fall short of the ceiling: for each signal the shortest run
// of bands with most of its excess, and the operating points that have more of it than the mean.
#ifndef HOWL_DIAGNOSIS_BUDGET_PLACES_LEFT_H_
#define HOWL_DIAGNOSIS_BUDGET_PLACES_LEFT_H_

#include <vector>

#include "diagnosis/budget/held_out.h"
#include "diagnosis/fit/estimated_parameter.h"

namespace howl {

// The larger share first: kAcoustics for p given q, kFlame for q given p.
std::vector<Place> PlacesLeft(const std::vector<CutRecord>& records, const HeldOutScore& score);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_PLACES_LEFT_H_
