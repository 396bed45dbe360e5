// Where a structure's predictions still fall short of the ceiling: for each signal the shortest run
// of bands with most of its excess, and the operating points that have more of it than the mean.
#ifndef HOWL_DIAGNOSIS_HELD_OUT_PLACES_LEFT_H_
#define HOWL_DIAGNOSIS_HELD_OUT_PLACES_LEFT_H_

#include <string>
#include <vector>

#include "diagnosis/fit/estimated_parameter.h"
#include "diagnosis/held_out/held_out_score.h"

namespace howl {

// `score` with what another structure errs by as its ceiling: PlacesLeft then says where it falls
// short of that one.
HeldOutScore Beside(HeldOutScore score, const HeldOutScore& other);

// All bands and operating points.
Place Everywhere(const std::vector<std::string>& names, const HeldOutScore& score);

// The larger share first: kAcoustics for p given q, kFlame for q given p.
std::vector<Place> PlacesLeft(const std::vector<std::string>& names, const HeldOutScore& score);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_HELD_OUT_PLACES_LEFT_H_
