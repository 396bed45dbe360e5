// Another place for each mode of a fit. What the likelihood has of maxima beside the best differ
// mostly in one mode: it lies in a peak that another has already, or has gone to where the record
// shows nothing. The fit itself cannot move it, for all places between are worse.
//
// Each mode in turn is taken away, and put where in cut A it leaves least beside the others
// (pole_starts.h), with residues anew for all. From each of these places the fit goes up to its
// maximum.
#ifndef HOWL_ESTIMATION_RECORD_FIT_MODE_MAXIMA_H_
#define HOWL_ESTIMATION_RECORD_FIT_MODE_MAXIMA_H_

#include "estimation/record_fit/loop/point_prior.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

// The most likely of these maxima, that of `fit` with them, as long as that leads to a better one.
// `fit` itself where the frequencies are tied.
PointFit BestByModes(const RecordSpectra& record, const PointStructure& structure,
                     const PointPrior& prior, PointFit fit);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_MODE_MAXIMA_H_
