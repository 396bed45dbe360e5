// What an instrument's range and steps leave in the samples themselves, detected without a model: a
// density that ends in an edge, an extreme value that repeats, few levels.
#ifndef HOWL_DIAGNOSIS_SAMPLES_SAMPLE_LIMITS_H_
#define HOWL_DIAGNOSIS_SAMPLES_SAMPLE_LIMITS_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/records/cut_record.h"
#include "model/loop/instrument.h"

namespace howl {

// The share of the samples that a saturation held at either end of the range before noise was
// added: the signal's density ends in an edge on both sides. So many samples lie no nearer the ends
// of a cycle's range: of a sine, whose density rises most, three times as many as a little further
// in, where a saturation makes eight times and more (tests/diagnosis/samples/noisy_rails_test.cc).
// Zero without such edges. What a flame makes of p may be as flat: of heat release that says
// nothing.
double ShareOnNoisyRails(const Eigen::VectorXd& x);
double ShareOnNoisyRails(const std::vector<double>& samples);

// True if in most records the density of the signal's values ends in an edge.
bool HasSharpEdge(const std::vector<CutRecord>& records, Channel channel);

struct FewLevels {
  bool found = false;
  double levels = 0.0;  // mean over the experiments
};

FewLevels FindQuantisation(const std::vector<CutRecord>& records);

// share: 0 ... 1.
double SampleQuantile(const Eigen::VectorXd& x, double share);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLES_SAMPLE_LIMITS_H_
