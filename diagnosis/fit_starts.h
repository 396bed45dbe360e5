// Where the joint fit (effect_fit.h) begins its searches.
#ifndef HOWL_DIAGNOSIS_FIT_STARTS_H_
#define HOWL_DIAGNOSIS_FIT_STARTS_H_

#include <vector>

#include "diagnosis/fitter.h"

namespace howl {

using StartList = std::vector<std::vector<double>>;

// The flame's columns of all records where no effect bends its input.
std::vector<FlameColumns> BaseColumns(const std::vector<CutRecord>& records);

// The delay by which Phi(v) explains q best, on a grid that no resonance of the objective escapes.
double StartDelay(const std::vector<CutRecord>& records, const std::vector<FlameColumns>& columns);

// tau_s of the base, less the lag that the effect adds at the cycle.
double CorrectedDelay(const std::vector<CutRecord>& records, const Effect& effect, EffectValues x,
                      double tau_s);

// All combinations of the parameters' starts, the first ones as `first` has them.
StartList StartValues(const Effect& effect, const std::vector<double>& first);

// Where a weak effect would take off most: of the scanned values the best few that are no
// neighbours, with the next parameter at its best.
StartList ScannedStarts(const EffectPointer& effect, const EffectFit& base, Fitter* fitter);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_STARTS_H_
