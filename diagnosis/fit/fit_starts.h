// Where the joint fit (effect_fit.h) begins its searches.
#ifndef HOWL_DIAGNOSIS_FIT_FIT_STARTS_H_
#define HOWL_DIAGNOSIS_FIT_FIT_STARTS_H_

#include <vector>

#include "diagnosis/fit/fitter.h"

namespace howl {

using StartList = std::vector<std::vector<double>>;

// The flame's columns of all records, where no effect changes the flame's input.
std::vector<FlameColumns> BaseColumns(const std::vector<CutRecord>& records);

// The delay with which Phi(v) explains q best, on a grid fine enough for all minima of the
// objective.
double StartDelay(const std::vector<CutRecord>& records, const std::vector<FlameColumns>& columns);

// The base's tau_s, less the lag that the effect adds at the cycle.
double CorrectedDelay(const std::vector<EffectContext>& points, const Effect& effect,
                      EffectValues x, double tau_s);

// All combinations of the parameters' starts; the first parameters have the values in `first`.
StartList StartValues(const Effect& effect, const std::vector<double>& first);

// Starts where a weak effect would gain most: the best few of the scanned values that are no
// neighbours, each with the next parameter at its best.
StartList ScannedStarts(const EffectPointer& effect, const EffectFit& base, Fitter* fitter);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_FIT_STARTS_H_
