// Half of the 95 % interval that a reported standard deviation stands for: value +- 1.96 std,
// whatever the degrees of freedom were (estimation/analysis/spectra/statistics.h). Whatever howl
// shows to a reader after a +- is this number; columns of files whose name ends in _std hold the
// standard deviation.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_HALF_WIDTH_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_HALF_WIDTH_H_

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

// The half width in the unit of `std`; NaN where the error is not known.
constexpr double HalfWidth95(double std) { return kNormal95 * std; }
constexpr double HalfWidth95(const Estimate& estimate) { return HalfWidth95(estimate.std); }

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_HALF_WIDTH_H_
