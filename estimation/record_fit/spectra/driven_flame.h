// What a flame may make of p: each of its functions (flame_functions.h) of the input that p gives
// it, taken in time and transformed, and behind it what filters the flame's answer.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_DRIVEN_FLAME_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_DRIVEN_FLAME_H_

#include <Eigen/Core>

#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// Of this p, from no frequency on. Where the record's scale has no functions yet, those that the
// prior calls smooth are set. But for these all of the record but its flame is there.
void SetFlame(Eigen::VectorXcd pressure, const FlamePrior& prior, RecordSpectra* record);

// With these filters beside those of the record.
void FilterFlame(const FlameFilters& filters, RecordSpectra* record);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_DRIVEN_FLAME_H_
