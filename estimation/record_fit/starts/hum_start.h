// Where a fit looks for hum, or for a tone.
#ifndef HOWL_ESTIMATION_RECORD_FIT_STARTS_HUM_START_H_
#define HOWL_ESTIMATION_RECORD_FIT_STARTS_HUM_START_H_

#include "estimation/record_fit/spectra/record_spectra.h"
#include "estimation/record_fit/whittle/noise_sources.h"
#include "estimation/record_fit/whittle/whittle.h"

namespace howl {

// Coefficients of the spectrum that the residuals of hum's channel have at the mains' lines: from
// far below a fit would not see that it rises, and from far above at lines that have none it would
// fall at all of them. Where no line tells of hum, the level of all bins.
Eigen::VectorXd HumStart(const RecordSpectra& record, const NoiseTerm& hum,
                         const LoopResiduals& left);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_STARTS_HUM_START_H_
