// Where a verdict of records lies.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_PLACES_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_PLACES_H_

#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"

namespace howl {

// Of what is named the places, by what each is worth. Of what nothing explains where it is: at the
// cycle's lines, if it shows there, for they tell most; else where the gap is left.
// least_of_lines: what free errors of a cut must gain, in nats, to be such.
std::vector<Place> PlacesOf(const LoopDiagnosis& of, double least_of_lines);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_PLACES_H_
