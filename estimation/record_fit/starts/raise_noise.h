// As much noise as a start's residuals show: what it misses at the cycle's lines is far more than
// what smooth spectra hold, and a fit that begins with too little noise may spend all its steps on
// the way to what is enough.
#ifndef HOWL_ESTIMATION_RECORD_FIT_STARTS_RAISE_NOISE_H_
#define HOWL_ESTIMATION_RECORD_FIT_STARTS_RAISE_NOISE_H_

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// All sources together have the level that is most likely, or stay where that is below theirs.
void RaiseNoise(const RecordSpectra& record, const PointStructure& structure, LoopPoint* point);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_STARTS_RAISE_NOISE_H_
