// The gap, dimensionless and free of the cycle's phase (diagnosis.h).
#ifndef HOWL_DIAGNOSIS_GAP_GAP_H_
#define HOWL_DIAGNOSIS_GAP_GAP_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct GapParts {
  std::vector<double> acoustic;  // mean of |E|^2 / V less one, for each experiment
  std::vector<double> flame;
};

struct BinRange {
  Eigen::Index first = 0;
  Eigen::Index last = 0;  // one beyond
};

// The mean of |E|^2 / V less one over some bins; NaN where none counts. share: the weight of each
// bin; empty: ones. without_masked: lines are not counted.
double MeanExcess(const CutRecord& record, const BinRange& bins, const Eigen::VectorXcd& residual,
                  const Eigen::VectorXd& variance, const Eigen::VectorXd& share,
                  bool without_masked);

// flame_noise: V_B of each experiment. without_masked: lines are not counted.
GapParts ComputeGapParts(const std::vector<CutRecord>& records,
                         const std::vector<ExperimentFit>& residuals,
                         const std::vector<Eigen::VectorXd>& flame_noise, bool without_masked);

double Gap(const GapParts& parts);

// The gap that noise alone has.
double GapFloor(const std::vector<CutRecord>& records);

struct ConfidenceInterval {
  double low = 0.0;
  double high = 0.0;
};

// 1 - after / before, 95 % over the experiments (jackknife).
ConfidenceInterval ShrinkageInterval(const GapParts& before, const GapParts& after);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_GAP_GAP_H_
