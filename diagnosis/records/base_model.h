// The loop that a diagnosis starts from, as the config has it: the paper's (5a) with one mode or
// two, and its delay. omega, xi, N and M are each experiment's own. The delay is one for all, or
// each experiment's own, scattered about one by as much as the records say (delay_scatter.h).
#ifndef HOWL_DIAGNOSIS_RECORDS_BASE_MODEL_H_
#define HOWL_DIAGNOSIS_RECORDS_BASE_MODEL_H_

#include "model/loop/acoustics.h"

namespace howl {

struct BaseModel {
  int modes = 2;                                // 1: M is zero
  double harmonic_ratio = kPaperHarmonicRatio;  // the second mode's frequency over the first's
  bool own_delays = false;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_RECORDS_BASE_MODEL_H_
