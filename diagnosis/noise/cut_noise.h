// Noise and likelihood of a record's cuts (noise_fit.h), with what a reference knows of them
// (CutReference): the noise's shape, and how much a bin counts for. Without a reference they are
// those of noise_fit.h, bit for bit.
#ifndef HOWL_DIAGNOSIS_NOISE_CUT_NOISE_H_
#define HOWL_DIAGNOSIS_NOISE_CUT_NOISE_H_

#include <Eigen/Core>

#include "diagnosis/records/cut_record.h"

namespace howl {

// gain_squared: |R|^2 on the band.
Eigen::VectorXd FitAcousticNoise(const CutRecord& record, const Eigen::VectorXcd& residual,
                                 const Eigen::VectorXd& gain_squared);
Eigen::VectorXd FitFlameNoise(const CutRecord& record, const Eigen::VectorXcd& residual);

double AcousticCost(const CutRecord& record, const Eigen::VectorXcd& residual,
                    const Eigen::VectorXd& variance);
double FlameCost(const CutRecord& record, const Eigen::VectorXcd& residual,
                 const Eigen::VectorXd& variance);

// Weights of least squares: 1 / V times what the bin counts for; 0 where masked.
Eigen::VectorXd AcousticWeights(const CutRecord& record, const Eigen::VectorXd& variance);
Eigen::VectorXd FlameWeights(const CutRecord& record, const Eigen::VectorXd& variance);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NOISE_CUT_NOISE_H_
