// Why the loop of a budget is not the rig's, in words; empty where it may be.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_WHY_UNKNOWN_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_WHY_UNKNOWN_H_

#include <cstddef>
#include <string>

#include "diagnosis/verdict/budget.h"

namespace howl {

// An item without which one half of the records is foretold better, by the odds against any item.
std::string HalfThatSpeaksAgainst(const Budget& budget);

// An effect of the catalogue that would have a value outside its bounds, of those without a unit:
// times and frequencies have the bounds of rigs of another size.
std::string ValueThatCannotBe(const Budget& budget);

// `named` causes would be named.
std::string WhyUnknown(const Budget& budget, bool errs_at_lines, std::ptrdiff_t named);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_WHY_UNKNOWN_H_
