// The sum of -2 w ln |D| over all frequencies beside a record's band (return_difference.h).
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_BESIDE_BAND_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_BESIDE_BAND_H_

#include <Eigen/Core>
#include <complex>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/loop_tail.h"

namespace howl {

// A sum with its slopes by the loop's parameters and by the flame's slope.
struct LoopGradient {
  Eigen::VectorXd loop;
  double slope = 0.0;
  double value = 0.0;

  // `over`: of d (slope U).
  void Add(const PointStructure& structure, const LoopPoint& point, double slope_now,
           const LoopAt& at, std::complex<double> over) {
    at.AddSlopes(structure, point, slope_now * over, &loop);
    slope += (over * at.u).real();
  }
};

double BesideBand(const RecordSpectra& record, const LoopPoint& point, const LoopTail& tail);
LoopGradient BesideBandGradient(const RecordSpectra& record, const PointStructure& structure,
                                const LoopPoint& point, const LoopTail& tail);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_BESIDE_BAND_H_
