// The loop that a diagnosis starts from, as the config has it: the paper's (5a) with one mode or
// two, and its delay. omega, xi, N and M are each experiment's own. The delays may scatter about
// one that all share (delay_scatter.h), by as much as the records say and at most
//
//   delay_scatter_max    standard deviation of log tau; 0: one delay for all
//
// No command asks for scatter yet: with it a rig without an effect, of four operating points, was
// accused of amplitude_dependent_delay.
#ifndef HOWL_DIAGNOSIS_BASE_MODEL_H_
#define HOWL_DIAGNOSIS_BASE_MODEL_H_

#include "model/acoustics.h"

namespace howl {

struct BaseModel {
  int modes = 2;                               // 1: M is zero
  double harmonic_ratio = kSeedHarmonicRatio;  // the second mode's frequency over the first's
  double delay_scatter_max = 0.0;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BASE_MODEL_H_
