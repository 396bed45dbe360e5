// The search for a point's other maxima: delays first (delay_maxima.h), then modes (mode_maxima.h).
#ifndef HOWL_ESTIMATION_RECORD_FIT_OTHER_MAXIMA_H_
#define HOWL_ESTIMATION_RECORD_FIT_OTHER_MAXIMA_H_

#include "estimation/record_fit/point_fit.h"

namespace howl {

// `fit`, or the most likely that is found from there.
PointFit BestOfOtherMaxima(const RecordSpectra& record, const PointStructure& structure,
                           const PointPrior& prior, PointFit fit);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_OTHER_MAXIMA_H_
