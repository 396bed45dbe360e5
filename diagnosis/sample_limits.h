// What an instrument's range and steps leave in the samples themselves, seen without any model: a
// density that ends in an edge, an extreme value that repeats, few levels.
#ifndef HOWL_DIAGNOSIS_SAMPLE_LIMITS_H_
#define HOWL_DIAGNOSIS_SAMPLE_LIMITS_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/cut_record.h"

namespace howl {

// One where saturation holds the signal at that end of its range, zero elsewhere.
struct Plateaus {
  Eigen::ArrayXd upper;
  Eigen::ArrayXd lower;
};

Plateaus FindPlateaus(const Eigen::VectorXd& x);

// In most records: the density of the signal's values ends in an edge.
bool HasSharpEdge(const std::vector<CutRecord>& records, bool pressure);

struct FewLevels {
  bool found = false;
  double levels = 0.0;  // mean over the experiments
};

FewLevels FindQuantisation(const std::vector<CutRecord>& records);

// share: 0 ... 1.
double SampleQuantile(const Eigen::VectorXd& x, double share);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLE_LIMITS_H_
