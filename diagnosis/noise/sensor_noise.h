// White sensor noise on both channels, without a model of the acoustics: in short bands q predicts
// p through a transfer function that is smooth there (a quadratic in frequency, by least squares);
// what it leaves over is sigma_p^2 + |R|^2 sigma_q^2.
//
// The flame is driven by the derivative of recorded p, whose noise would bias its response towards
// zero where the signal is weak, and look like a low-pass. So p is first replaced by its
// expectation given the record: times 1 - sigma_p^2 / S_pp (Wiener). A regression on that is not
// biased. q, which drives the acoustics, is replaced likewise where its spectrum falls to its
// noise, as it does behind a low-pass.
#ifndef HOWL_DIAGNOSIS_NOISE_SENSOR_NOISE_H_
#define HOWL_DIAGNOSIS_NOISE_SENSOR_NOISE_H_

#include <Eigen/Core>

#include "diagnosis/records/cut_record.h"

namespace howl {

struct SensorNoise {
  Eigen::VectorXd variance;  // sigma_p^2 + |R|^2 sigma_q^2 on the band of cut A
  // sigma_p^2 and sigma_q^2, in units of |P|^2 and |Q|^2 under the window.
  double pressure_variance = 0.0;
  double heat_release_variance = 0.0;
};

SensorNoise EstimateSensorNoise(const CutRecord& record);

// 1 - sigma^2 / S over the half spectrum, S smoothed over a few bins; between 0 and 1.
Eigen::VectorXd PressureShrinkage(const CutRecord& record, double noise_variance);
Eigen::VectorXd HeatReleaseShrinkage(const CutRecord& record, double noise_variance);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NOISE_SENSOR_NOISE_H_
