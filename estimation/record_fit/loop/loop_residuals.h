// What an operating point's loop leaves of its record, with the slopes by all parameters
// (loop_point.h).
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_RESIDUALS_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_RESIDUALS_H_

#include <array>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/spectra/record_spectra.h"
#include "estimation/record_fit/whittle/whittle.h"

namespace howl {

// R, F, the lines' factors and the slow changes' part on the record's bins, without the rest of the
// residuals.
LoopResiduals TransfersOf(const RecordSpectra& record, const LoopPoint& point);
LoopResiduals ResidualsOf(const RecordSpectra& record, const PointStructure& structure,
                          const LoopPoint& point);
// What the flame gives out of q, on the transform's bins, but for errors at the cycle's lines.
Eigen::VectorXcd AnswerOfFlame(const RecordSpectra& record, const LoopPoint& point);
// The path's answer on the record's bins, with V in it, and on the transform's, with the slopes of
// its logarithm by each of its parameters.
struct PathOnGrids {
  Eigen::VectorXcd at, edge_at;
  std::array<Eigen::VectorXcd, kMostPathParameters> by, edge_by;
};
void SetPath(const RecordSpectra& record, const PointStructure& structure, const LoopPoint& point,
             PathOnGrids* out);

LoopDerivatives DerivativesOf(const RecordSpectra& record, const PointStructure& structure,
                              const LoopPoint& point, const PathOnGrids& path);
LoopDerivatives DerivativesOf(const RecordSpectra& record, const PointStructure& structure,
                              const LoopPoint& point);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_RESIDUALS_H_
