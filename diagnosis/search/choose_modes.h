// Chooses one mode or two where the config does not state it: both bases are fitted, and the second
// mode stays if its gain exceeds the price of its coefficients by more than noise gives
// (verdict.h).
#ifndef HOWL_DIAGNOSIS_SEARCH_CHOOSE_MODES_H_
#define HOWL_DIAGNOSIS_SEARCH_CHOOSE_MODES_H_

#include <vector>

#include "diagnosis/records/cut_record.h"

namespace howl {

struct ModesChoice {
  int modes = 1;
  double second_mode_gain = 0.0;  // of log-likelihood, its coefficients paid for
};

ModesChoice ChooseModes(const std::vector<DiagnosisExperiment>& experiments, BaseModel model);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SEARCH_CHOOSE_MODES_H_
