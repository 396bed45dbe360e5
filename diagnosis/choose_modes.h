// One mode or two where nobody states it: both bases are fitted, and the second mode stays where
// what it takes off the likelihood exceeds the price of its coefficients by what noise does not
// reach (verdict.h).
#ifndef HOWL_DIAGNOSIS_CHOOSE_MODES_H_
#define HOWL_DIAGNOSIS_CHOOSE_MODES_H_

#include <vector>

#include "diagnosis/cut_record.h"

namespace howl {

struct ModesChoice {
  int modes = 1;
  double second_mode_gain = 0.0;  // of log-likelihood, its coefficients paid for
};

ModesChoice ChooseModes(const std::vector<DiagnosisExperiment>& experiments, BaseModel model);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CHOOSE_MODES_H_
