// The loop that either half of each record shows by itself, by the law of the other points.
//
// Two halves of one record are two records of one loop: where the model is the rig's they differ as
// their errors say, and where it is not, as where the likelihood has maxima between which the model
// cannot tell, by more (interval_scale.h). What a half comes to may be a better maximum of the
// whole record too.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_HALF_FITS_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_HALF_FITS_H_

#include <array>
#include <optional>
#include <vector>

#include "estimation/joint_records/fitted_loop.h"
#include "estimation/joint_records/loop_record.h"
#include "estimation/joint_records/records_fit.h"

namespace howl {

using HalfFits = std::array<PointFit, 2>;
using HalfLoops = std::array<FittedLoop, 2>;

// Of each point, where there are several without a look at what the whole record came to, but
// searched for other maxima as it was. `records`: what `points` were made of, whose loops `fit`
// has. Of `options` threads, units and key hold, here and below.
std::vector<HalfFits> FitHalves(const std::vector<LoopRecord>& records,
                                const std::vector<OperatingPoint>& points, const RecordsFit& fit,
                                const RecordsFitOptions& options);

std::vector<HalfLoops> LoopsOfHalves(const std::vector<LoopRecord>& records,
                                     const std::vector<OperatingPoint>& points,
                                     const PointStructure& structure,
                                     const std::vector<HalfFits>& halves);

// What all points come to together where one of a point's halves has led its whole record to a
// better maximum; none where none has.
std::optional<RecordsFit> BetterByHalves(const std::vector<OperatingPoint>& points,
                                         const RecordsFit& fit, const std::vector<HalfFits>& halves,
                                         const RecordsFitOptions& options);

struct FitWithHalves {
  RecordsFit fit;
  std::vector<HalfFits> halves;
  std::vector<double> log_density;  // of each point, left out (LeftOutDensities)
};

// `fit`, or what halves lead to as long as the points foretell one another better by it; with the
// halves that belong to it.
FitWithHalves GoOnFromHalves(const std::vector<LoopRecord>& records,
                             const std::vector<OperatingPoint>& points, RecordsFit fit,
                             const RecordsFitOptions& options);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_HALF_FITS_H_
