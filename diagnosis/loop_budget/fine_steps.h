// Steps of a converter that are fine enough to leave a signal its shape, and coarse enough to be
// its noise.
//
// The values of such a signal are few, and are whole multiples of one step. Rounding to the nearest
// adds a white noise of variance step^2 / 12 (Bennett 1948). It is the signal's noise where it is
// at least half of the floor: of the median power over the upper half of the frequencies, which of
// white noise is ln 2 of its mean.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FINE_STEPS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FINE_STEPS_H_

#include <vector>

namespace howl {

// Of eight bits: a signal of more levels is called no coarse one, whatever its noise.
inline constexpr int kMostLevels = 256;

// How many levels of such steps lie between the least and the largest sample; 0: it has none.
int LevelsOfFineSteps(const std::vector<double>& signal);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FINE_STEPS_H_
