// What of a record of p is noise, as far as a loop fitted to the record tells: its expectation,
// given both residuals of the loop's cuts (whittle.h), bin by bin,
//
//   N = sum_j p_j S_j u_j^H Sigma^-1 (E_A, E_B),   p_j: 1 of p's sensor and of its hum, beta of the
//                                                  background, else 0       noise_sources.h
//
// It is no noise where E^H Sigma^-1 E is larger than one bin in ten thousand of a right loop has
// it, as where the loop misses one of the cycle's lines. The residuals are under the sine taper
// (record_spectra.h), by which the noise is divided but near the record's ends.
//
// Above the band it is taken to be as strong as at the band's upper end, but for what an instrument
// of p that was taken out makes of it: what of p stands out of it there, by the same odds, is p.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_PRESSURE_NOISE_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_PRESSURE_NOISE_H_

#include <Eigen/Core>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// Over p's unit, one value a sample, of all frequencies from the record's band on that the flame's
// input holds.
Eigen::VectorXd PressureNoise(const RecordSpectra& record, const PointStructure& structure,
                              const Eigen::VectorXd& parameters);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_PRESSURE_NOISE_H_
